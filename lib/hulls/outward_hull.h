#pragma once
#include <span>

#include "lib/hulls/convex_hull.h"

namespace bp {

/// A hull of lattice points strictly around `points`, which are in lattice units and not rounded, and around all that
/// is within `off` of them: no face lies farther out than rounding needs, a unit or two. It has no more corners than
/// the hull of the points, if each corner has a place beyond the faces around it; of plates and needles thinner than a
/// unit it has a few more. Decided in integers. The points: one at least, at most a 16th of a unit off by computing,
/// spanning less than 2^29 units. Cost: the product of the points and their hull's faces.
[[nodiscard]] ConvexHull outward_hull(std::span<const Vec3d> points, double off = 0);

}  // namespace bp
