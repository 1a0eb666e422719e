#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "lib/core/texture.h"

/// TGA and BMP, as old scenes have them.
namespace bp {

/// Width and height of the first bytes of such a file; nothing if it is of another kind. A TGA has no mark: its header
/// must make sense.
[[nodiscard]] std::optional<std::array<int, 2>> old_image_size(std::span<const std::byte> head);

/// Without alpha, or with none but 0, it is opaque. Nothing if it is broken or cut off. Twice its memory is taken
/// meanwhile.
[[nodiscard]] std::optional<TextureImage> decode_old_image(std::span<const std::byte> bytes);

}  // namespace bp
