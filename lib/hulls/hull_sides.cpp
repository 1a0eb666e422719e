#include "lib/hulls/hull_sides.h"

#include <algorithm>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

HullSides::HullSides(const ConvexHull& hull) {
  for (const auto& t : hull.triangles) {
    const LatticeCoord a = hull.vertices[t[0]];
    sides_.push_back({a, normal_of(a, hull.vertices[t[1]], hull.vertices[t[2]])});
  }
}

bool HullSides::hold(const LatticeBox& box) const {
  return std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    return side_along(side.normal, farthest_of(box, side.normal) - side.point) <= 0;
  });
}

LatticeCoord farthest_of(const LatticeBox& box, const LatticeCoord& normal) {
  LatticeCoord p;
  for (int k = 0; k < 3; ++k) p[k] = normal[k] > 0 ? box.max[k] : box.min[k];
  return p;
}

void add_corners(const LatticeBox& box, std::vector<LatticeCoord>& points) {
  if (box.min == box.max) return points.push_back(box.min);
  for (int i = 0; i < 8; ++i) {
    LatticeCoord& p = points.emplace_back();
    for (int k = 0; k < 3; ++k) p[k] = (i >> k & 1) != 0 ? box.max[k] : box.min[k];
  }
}

}  // namespace bp
