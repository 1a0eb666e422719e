#pragma once
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// A corner of a triangle of the scene, or a point where a face of a box cuts it.
struct CutPoint {
  Vec3d at{};
  std::array<double, 3> normal{};
  std::array<double, 2> uv{}, second_uv{};
  std::array<double, 3> color{};  ///< linear light, 0 to 65535
};

/// Returns the part of a triangle in the closed box: a convex polygon, or nothing. Triangles with a common edge are cut
/// at the same points of it. Boxes with a common face have the same points on that face, bit for bit; one box may have
/// more points there than its neighbour. The triangle's corners may come in any order.
[[nodiscard]] std::vector<CutPoint> cut_triangle(const std::array<CutPoint, 3>& triangle, const Bounds3d& box);

}  // namespace bp
