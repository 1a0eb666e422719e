#pragma once
#include "lib/core/texture.h"

/// Images that MTL names as `bump`: some programs write heights there, others directions (docs/levels.md).
namespace bp {

/// The interpretation of an image as a relief.
struct Relief {
  double strength = 1;  ///< heights: texels between black and white; directions: factor of their slopes
  /// The texel beyond an edge is the one at the opposite edge; else texels at an edge have one neighbour.
  bool repeats = true;
  friend bool operator==(const Relief&, const Relief&) = default;
};

/// Returns whether all texels are grey, as heights are. Small differences, which JPEG adds, are ignored. O(texels).
[[nodiscard]] bool is_grey(const TextureImage& image);

/// Turns heights into directions in tangent space, green upwards (TextureSurface::normal). The slope at a texel is that
/// between its two neighbours. The strength is applied before slopes are rounded to bytes: a step of one grey value is
/// 1/255 of a texel, and would be lost. O(texels); in place, with four rows in addition.
void turn_into_directions(TextureImage& heights, const Relief& relief);

/// Multiplies the slopes of directions, as a normal map's scale does. O(texels).
void strengthen(TextureImage& directions, double strength);

}  // namespace bp
