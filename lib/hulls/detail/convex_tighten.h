#pragma once
#include <span>

#include "lib/hulls/convex_hull.h"

/// Makes convex hulls tighter around their points.
namespace bp {

/// Moves each corner of `hull` to the place of least volume at which all of `points`, which lie in it, stay in it. That
/// is a linear program in three variables, solved in floating point and taken if exact signs confirm it. The result has
/// no more corners than before, and no more slivers (convex_shape.h). Cost: milliseconds for some hundred points.
[[nodiscard]] ConvexHull tightened(ConvexHull hull, std::span<const LatticeCoord> points);

/// Returns whether all points lie in the closed hull. Exact. Cost: the product of both.
[[nodiscard]] bool holds_all(const ConvexHull& hull, std::span<const LatticeCoord> points);

}  // namespace bp
