#pragma once
#include "lib/check/detail/mesh_topology.h"
#include "lib/core/triangle_source.h"

/// A proxy of convex parts, as physics engines take it: the union of solids that may overlap. A part is a component.
namespace bp {

/// index: the first triangle of a part that is not the boundary of a convex solid, facing outwards; other: a vertex of
/// the part that lies beyond one of its triangles. Exact, for a closed and oriented mesh whose parts do not intersect
/// themselves. O(f v) for parts of f triangles and v vertices, parallel.
[[nodiscard]] Finding nonconvex_parts(const WeldedMesh& mesh, std::size_t max_examples);

/// Which triangles of a scene the open parts cover: each of their points lies strictly within a part.
struct ConvexReport {
  std::uint64_t triangles = 0;  ///< of the scene, tested
  Bounds3d bounds;              ///< of these
  Finding not_held;             ///< index: scene triangle with a point that no part holds
  Finding perhaps_not_held;     ///< index: scene triangle that is neither proved to be covered nor to be bare
  Finding within_rounding;      ///< index: scene triangle that is covered as read, but not by as much as it may be off
  Finding undecidable;          ///< index: scene triangle outside the domain of exact predicates
};

/// Reads the scene once from its start, and a second time if it was rounded (SceneCounts::rounding), or the proxy, by
/// up to `proxy_off`; memory does not grow with it. Whatever the parts are: what lies below the planes of all triangles
/// of a closed part lies within it. Exact for triangles that lie within one part, and for corners that lie in none; the
/// others are decided with bounds of all rounding (convex_cover.h), or not. Time: linear in the scene, times the
/// triangles of the parts that one meets.
[[nodiscard]] ConvexReport check_convex(const WeldedMesh& mesh, TriangleSource& scene, std::size_t max_examples,
                                        double proxy_off = 0);

}  // namespace bp
