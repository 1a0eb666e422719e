#pragma once
#include <array>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/coords.h"

/// Cuts off parts far beyond a picture, so that edges can be decided in integers.
namespace bp {

struct ClippedTriangle {
  TriangleD corners;
  TriangleColors colors;
};

/// Returns the part of a triangle with |x| and |y| of at most `limit`, as a fan with depth and colours. Two triangles
/// with a common edge are cut at the same points of it. Empty if a coordinate is not finite.
[[nodiscard]] std::vector<ClippedTriangle> clip(const TriangleD& t, const TriangleColors& colors, double limit);

/// Cuts a line likewise. Returns false if nothing of it is left.
[[nodiscard]] bool clip(std::array<Vec3d, 2>& line, double limit);

}  // namespace bp
