#pragma once
#include "lib/core/texture.h"

/// Images that MTL names as `bump`: some programs write heights there, others directions (docs/levels.md).
namespace bp {

/// Whether all texels are grey, as heights are; what JPEG adds to grey is not seen. O(texels).
[[nodiscard]] bool is_grey(const TextureImage& image);

/// Heights as directions in tangent space, green upwards (TextureSurface::normal): white is one texel higher than
/// black, so that a step of a grey value is 1/255 of a texel. Slopes are those between the two neighbours of a texel,
/// at the edge of the image between the texel and its one neighbour. O(texels).
[[nodiscard]] TextureImage directions_of(const TextureImage& heights);

}  // namespace bp
