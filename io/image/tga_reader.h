#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "lib/core/texture.h"

/// Reader of TGA, which old scenes use.
namespace bp {

/// Returns width and height from the first bytes of a TGA; nothing for another kind. A TGA has no magic number, so its
/// header must make sense.
[[nodiscard]] std::optional<std::array<int, 2>> tga_size(std::span<const std::byte> head);

/// Decodes a TGA; opaque if it has no alpha, or only alpha 0. Returns nothing if it is broken or cut off. Needs twice
/// the memory of the image.
[[nodiscard]] std::optional<TextureImage> decode_tga_bytes(std::span<const std::byte> bytes);

}  // namespace bp
