#pragma once
#include "lib/check/check_report.h"
#include "lib/check/detail/surface.h"
#include "lib/core/triangle_source.h"

/// Does a proxy lie strictly inside a scene, as an occluder must?
namespace bp {

/// Strictly inside: no triangle of the scene meets the solid that the proxy bounds, and every path from far away to a
/// part of it crosses the scene, since the scene, or a closed shell of it, winds around the part. Exact.
/// Triangles of no area count for their edges alone, if these close the T-junctions of the others: they bound nothing.
struct InsideReport {
  std::uint64_t triangles = 0;  ///< of the scene, tested: those with an area, from which numbers count
  Finding touching;             ///< index: scene triangle, other: proxy triangle that it touches or crosses
  Finding swallowed;            ///< index: scene triangle that lies inside the proxy
  Finding undecidable;          ///< index: scene triangle outside the domain of exact predicates
  bool scene_closed = false;  ///< each directed edge is used as often as its reverse; with those of no area or without
  Finding outside;    ///< index: first proxy triangle of a component that an eye far out along an axis sees, past all
                      ///< triangles of the scene
  Finding unsettled;  ///< index: first proxy triangle of a component that neither holds for: what is around it is open,
                      ///< or of parts that overlap
};

/// Reads the scene, which should have its triangles of no area, once from its start, and again where it does not wind
/// around a part. `mesh` must be closed and oriented. Whether the scene is closed is told by a keyed
/// sum of its edges (edge_sum.h). Memory does not grow with the scene, but for the second time: at most memory_bytes.
[[nodiscard]] InsideReport check_inside(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                                        std::size_t max_examples, std::uint64_t memory_bytes);

}  // namespace bp
