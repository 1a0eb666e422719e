#pragma once
#include <vector>

#include "lib/hulls/convex_hull.h"

/// Fewer hulls around the same solids: the second half of an approximate convex decomposition, after [MG09].
namespace bp {

/// A hull, and the solid that it is around.
struct Wrapped {
  ConvexHull hull;
  double solid6 = 0;        ///< six times the volume of the solid in its cells
  std::uint32_t solid = 0;  ///< number of its solid; hulls of different solids are joined only if there are too many
  bool given = false;       ///< it is a hull of the scene, joined only if there are too many
};

/// Joins hulls, first the pair (of those found near each other) whose common hull adds the least volume, until there
/// are `count`. Within each solid it goes on while one hull is nearly as good as two: it adds no more than a twentieth
/// of the two's volume, and has no more than twice what cut_to_convex() allows a cell above the solid in it. Cost:
/// quadratic in the hulls, for their boxes.
[[nodiscard]] std::vector<Wrapped> merge_hulls(std::vector<Wrapped> hulls, std::size_t count, double tolerance6);

}  // namespace bp
