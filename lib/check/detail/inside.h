#pragma once
#include "lib/check/check_report.h"
#include "lib/check/detail/surface.h"
#include "lib/core/triangle_source.h"

/// Checks whether a proxy lies strictly inside a scene, as an occluder must.
namespace bp {

/// The report on a proxy inside a scene. It is strictly inside if no triangle of the scene meets the proxy's solid, and
/// if every path from far away to a part of the proxy crosses the scene, since the scene or a closed shell of it winds
/// around the part. Exact. A triangle without area is the segment or the point of its corners, and its edges may close
/// the T-junctions of the others.
struct InsideReport {
  std::uint64_t triangles = 0;  ///< tested triangles of the scene
  Finding touching;             ///< index: scene triangle, other: proxy triangle that it touches or crosses
  Finding swallowed;            ///< index: scene triangle that lies inside the proxy
  Finding undecidable;          ///< index: scene triangle outside the domain of exact predicates
  /// Each directed edge is used as often as its reverse, with or without the triangles of no area.
  bool scene_closed = false;
  /// Index: first proxy triangle of a component that an eye far out along an axis sees, past all triangles of the
  /// scene.
  Finding outside;
  /// Index: first proxy triangle of a component that is neither seen nor enclosed: the scene around it is open, or
  /// consists of parts that overlap.
  Finding unsettled;
};

/// Checks the proxy. Reads the scene once from its start, and again if it does not wind around a part; it should have
/// its triangles of no area. `mesh` must be closed and oriented. A keyed sum of the scene's edges (edge_sum.h) tells
/// whether the scene is closed. Memory does not grow with the scene, except for the second time: at most memory_bytes.
[[nodiscard]] InsideReport check_inside(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                                        std::size_t max_examples, std::uint64_t memory_bytes);

}  // namespace bp
