#pragma once
#include <limits>
#include <vector>

#include "lib/geometry/triangle_bvh.h"

/// Distances between surfaces with a bound on their error: branch and bound over parts of triangles. What bounds a
/// part: distance is 1-Lipschitz, so d(centre) + radius; and the distance to one triangle is convex, so its largest
/// value over a part is at a corner. Parts are cut at the edges of the triangle nearest to them, so that this is sharp
/// where surfaces run side by side. Both bounds hold for real numbers; doubles add their rounding.
namespace bp {

/// From each point of one surface to the nearest point of another, scene units.
struct SurfaceDistance {
  double at_most = 0, at_least = 0;  ///< bounds of the largest: the one-sided Hausdorff distance lies between
  double mean = 0;                   ///< over the area; midpoint rule
  Vec3d where{};                     ///< a point as far as at_least
};

/// When a search gives up sharpness. at_most stays a bound.
struct SearchEffort {
  /// The tolerance doubles each time that so many parts of triangles, at least 1, have been looked at.
  std::size_t patience = 1 << 17;
  std::size_t more_parts = 1 << 18;  ///< kept at a time, in addition to the triangles; 120 bytes each
  /// The search ends where at_least exceeds this: then it is all that is known, and at_most says nothing.
  double enough = std::numeric_limits<double>::infinity();
};

/// Neither may be empty. at_most exceeds at_least by at most 0.1 % of it, 1e-7 of the bounds of `from`, or `tolerance`
/// (scene units), whatever is most: where many places are equally far, a little tolerance saves much. Where
/// SearchEffort::more_parts do not do, it exceeds it by more. Parallel; the result does not depend on the number of
/// threads. Cost: some 10^5 searches for the mean, few per triangle for the rest.
[[nodiscard]] SurfaceDistance surface_distance(const std::vector<TriangleD>& from, const TriangleBvh& to,
                                               double tolerance = 0);

/// The same without the mean, which is 0 then, and without its cost: few searches per triangle. A large face may be as
/// far from all of a fine surface; `effort` bounds what that takes.
[[nodiscard]] SurfaceDistance largest_distance(const std::vector<TriangleD>& from, const TriangleBvh& to,
                                               double tolerance = 0, const SearchEffort& effort = {});

}  // namespace bp
