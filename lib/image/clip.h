#pragma once
#include <array>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/coords.h"

/// Cuts what reaches far beyond a picture, so that edges can be decided in integers.
namespace bp {

struct ClippedTriangle {
  TriangleD corners;
  TriangleColors colors;
};

/// The part of a triangle with |x| and |y| of at most `limit`, as a fan; depth and colours go along. Two triangles with
/// a common edge are cut at the same points of it. Empty if a coordinate is not finite.
[[nodiscard]] std::vector<ClippedTriangle> clip(const TriangleD& t, const TriangleColors& colors, double limit);

/// The same of a line. False if nothing of it is left.
[[nodiscard]] bool clip(std::array<Vec3d, 2>& line, double limit);

}  // namespace bp
