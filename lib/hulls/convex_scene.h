#pragma once
#include <span>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"
#include "lib/hulls/convex_hull.h"

/// The convex parts of a scene, which need no decomposition.
namespace bp {

/// Triangles are connected across edges (by the places of their ends) that two triangles have in opposite directions. A
/// connected part is convex if it is closed and its hull has no more than kNearlyConvex above its volume.
struct ConvexScene {
  std::vector<std::vector<Vec3d>> parts;  ///< the hull's corners of each convex part, scene units
  std::vector<TriangleD> rest;            ///< the triangles of all other parts, in their order
  double volume = 0;                      ///< of the convex parts, scene units cubed
};

/// Finds the convex parts. Parts whose hulls have more than 4,096 corners count as round, and stay in the rest. O(n log
/// n).
[[nodiscard]] ConvexScene convex_scene(std::span<const TriangleD> scene);

/// Returns, for each part, the hull of its corners, rounded outwards to lattice points of `frame`: each point of the
/// part lies strictly within, wherever corners lie within `rounding` of their places. A hull has at most `corners`
/// corners, 8 or more. Corners that hold next to nothing go in any case, and no hull loses a point. Hulls within others
/// are left out. Parallel; the same for any number of threads.
[[nodiscard]] std::vector<ConvexHull> hulls_around(const ConvexScene& scene, const GridFrame& frame,
                                                   std::size_t corners, const Rounding& rounding = {});

}  // namespace bp
