#pragma once
#include "lib/core/texture.h"

/// Images that MTL names as `bump`: some programs write heights there, others directions (docs/levels.md).
namespace bp {

/// How an image is a relief.
struct Relief {
  double strength = 1;  ///< white is so many texels higher than black; what leans leans so much more
  bool repeats = true;  ///< beyond an edge is what lies at the opposite one; else an edge has one neighbour
  friend bool operator==(const Relief&, const Relief&) = default;
};

/// Whether all texels are grey, as heights are; what JPEG adds to grey is not seen. O(texels).
[[nodiscard]] bool is_grey(const TextureImage& image);

/// Turns heights into directions in tangent space, green upwards (TextureSurface::normal). Slopes are those between the
/// two neighbours of a texel. They have their strength before they become bytes: a step of one grey value is 1/255 of a
/// texel, and would be lost. O(texels); in place, with four rows beside it.
void turn_into_directions(TextureImage& heights, const Relief& relief);

/// Makes directions lean by the strength more, as a normal map's scale does. O(texels).
void strengthen(TextureImage& directions, double strength);

}  // namespace bp
