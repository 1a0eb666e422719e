#pragma once
#include <span>

#include "lib/hulls/convex_hull.h"

/// Convex hulls made tighter around what they hold.
namespace bp {

/// Moves the corners of `hull`, each to where the volume is least while all of `points`, which lie in it, stay in it:
/// a linear program in three variables, solved in floating point, and taken if exact signs say so. It has no more
/// corners than before, and no more slivers (convex_shape.h). Cost: milliseconds for some hundred points.
[[nodiscard]] ConvexHull tightened(ConvexHull hull, std::span<const LatticeCoord> points);

/// Whether all points lie in the closed hull. Exact; the product of both.
[[nodiscard]] bool holds_all(const ConvexHull& hull, std::span<const LatticeCoord> points);

}  // namespace bp
