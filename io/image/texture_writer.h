#pragma once
#include <string>

#include "lib/core/texture.h"

namespace bp {

/// An encoded image.
struct EncodedImage {
  std::string bytes;
  std::string type;  ///< "image/jpeg" or "image/png"
};

/// Encodes an image: JPEG (quality 90) if every texel is opaque, else PNG. Same image, same bytes (and libraries).
/// Throws bad_argument if a side is 0, out_of_resource if it cannot be compressed.
[[nodiscard]] EncodedImage encode_texture(const TextureImage& image);

}  // namespace bp
