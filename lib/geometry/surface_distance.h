#pragma once
#include <limits>
#include <vector>

#include "lib/geometry/triangle_bvh.h"

/// Distances between surfaces with a bound on their error, by branch and bound over parts of triangles. Two facts bound
/// a part. Distance is 1-Lipschitz, so d(centre) + radius is a bound. The distance to one triangle is convex, so its
/// largest value over a part is at a corner. Parts are cut at the edges of the triangle nearest to them, which makes
/// the second bound sharp where surfaces run side by side. Both bounds hold for real numbers; doubles add their
/// rounding.
namespace bp {

/// Distances from each point of one surface to the nearest point of another, scene units.
struct SurfaceDistance {
  /// Bounds of the largest distance: the one-sided Hausdorff distance lies between them.
  double at_most = 0, at_least = 0;
  double mean = 0;  ///< mean over the area, by the midpoint rule
  Vec3d where{};    ///< a point at the distance at_least
};

/// When a search gives up sharpness. at_most stays a bound in any case.
struct SearchEffort {
  /// The tolerance doubles each time that so many parts of triangles, at least 1, have been examined.
  std::size_t patience = 1 << 17;
  std::size_t more_parts = 1 << 18;  ///< parts that are kept at a time, in addition to the triangles; 120 bytes each
  /// The search ends once at_least exceeds this. Then at_least is all that is known, and at_most says nothing.
  double enough = std::numeric_limits<double>::infinity();
};

/// Measures the distances from `from` to `to`. Neither may be empty. at_most exceeds at_least by at most 0.1 % of it,
/// 1e-7 of the bounds of `from`, or `tolerance` (scene units), whichever is largest. If many places are equally far, a
/// little tolerance saves much time. If SearchEffort::more_parts do not suffice, at_most exceeds at_least by more.
/// Parallel; the result does not depend on the number of threads. Cost: some 10^5 searches for the mean, and few per
/// triangle for the rest.
[[nodiscard]] SurfaceDistance surface_distance(const std::vector<TriangleD>& from, const TriangleBvh& to,
                                               double tolerance = 0);

/// Measures without the mean, which is 0 then, and without its cost: few searches per triangle. A large face may be
/// equally far from all of a fine surface; `effort` bounds what that costs.
[[nodiscard]] SurfaceDistance largest_distance(const std::vector<TriangleD>& from, const TriangleBvh& to,
                                               double tolerance = 0, const SearchEffort& effort = {});

}  // namespace bp
