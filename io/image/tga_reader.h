#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "lib/core/texture.h"

/// TGA, as old scenes have it.
namespace bp {

/// Width and height, of the first bytes of such a file; nothing if it is of another kind. A TGA has no mark: its header
/// must make sense.
[[nodiscard]] std::optional<std::array<int, 2>> tga_size(std::span<const std::byte> head);

/// Without alpha, or with none but 0, it is opaque. Nothing if it is broken or cut off. Needs twice the memory of
/// the image.
[[nodiscard]] std::optional<TextureImage> decode_tga_bytes(std::span<const std::byte> bytes);

}  // namespace bp
