#pragma once
#include <vector>

#include "lib/hulls/convex_hull.h"
#include "lib/mesh/box_group.h"

namespace bp {

/// The planes of a hull. Keeps nothing of the hull itself.
class HullSides {
 public:
  explicit HullSides(const ConvexHull& hull);
  /// Returns whether the whole box lies in the hull. Exact.
  [[nodiscard]] bool hold(const LatticeBox& box) const;

 private:
  struct Side {
    LatticeCoord point, normal;
  };
  std::vector<Side> sides_;
};

/// Returns the corner of a box that lies farthest in the direction of `normal`.
[[nodiscard]] LatticeCoord farthest_of(const LatticeBox& box, const LatticeCoord& normal);

/// Appends the corners of a box: eight, or one if the box is a point.
void add_corners(const LatticeBox& box, std::vector<LatticeCoord>& points);

}  // namespace bp
