#pragma once
#include <vector>

#include "lib/meshing/convex_hull.h"

/// Fewer hulls around the same: the second half of an approximate convex decomposition, after [MG09].
namespace bp {

/// A hull, and what it is around.
struct Wrapped {
  ConvexHull hull;
  double solid6 = 0;  ///< six times the volume of the solid in its cells
};

/// Joins hulls, the pair first whose common hull adds the least volume, until there are `count`; and on, while one is
/// nearly as good as two: it adds no more than a twentieth of the two's volume, so bridges no gap, and has no more than
/// twice what cut_to_convex() allows a cell above the solid in it.
[[nodiscard]] std::vector<ConvexHull> merge_hulls(std::vector<Wrapped> hulls, std::size_t count, double tolerance6);

}  // namespace bp
