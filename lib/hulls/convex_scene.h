#pragma once
#include <span>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/hulls/convex_hull.h"

/// What of a scene is convex already, and needs no decomposition.
namespace bp {

/// Triangles are connected across edges, by the places of their ends, that two of them have in opposite directions. A
/// connected part is convex if it is closed and its hull has no more than kNearlyConvex above its volume.
struct ConvexScene {
  std::vector<std::vector<Vec3d>> parts;  ///< of each convex part the corners of its hull, scene units
  std::vector<TriangleD> rest;            ///< the triangles of all other parts, in their order
  double volume = 0;                      ///< of the convex parts, scene units cubed
};

/// Parts whose hulls have more than 4,096 corners are taken for round, and are left to the rest. O(n log n).
[[nodiscard]] ConvexScene convex_scene(std::span<const TriangleD> scene);

/// For each part the hull of its corners, rounded outwards to lattice points of `frame`: each point of the part lies
/// strictly within. At most `corners` corners a hull, 8 or more: those that hold next to nothing go in any case, and no
/// hull loses a point. Hulls within others are left out. Parallel; the same for any number of threads.
[[nodiscard]] std::vector<ConvexHull> hulls_around(const ConvexScene& scene, const GridFrame& frame,
                                                   std::size_t corners);

}  // namespace bp
