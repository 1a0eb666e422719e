#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "lib/core/texture.h"

namespace bp {

/// Decodes a PNG, JPEG, WebP or TGA, told apart by its first bytes. Without alpha it is opaque. Throws bad_input, with
/// `name`, if it is broken or of another kind, or has more than 2^28 pixels; out_of_resource if it takes more than
/// `most_bytes`.
[[nodiscard]] TextureImage decode_image(std::span<const std::byte> bytes, const std::string& name,
                                        std::uint64_t most_bytes);

/// Returns width and height from the first bytes of such a file: those before the pixels. Throws bad_input.
[[nodiscard]] std::array<int, 2> image_size(std::span<const std::byte> head, const std::string& name);

/// Returns whether the image is of a kind that glTF allows, or WebP; false for TGA. Throws bad_input if it is none of
/// these.
[[nodiscard]] bool is_web_image(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bp
