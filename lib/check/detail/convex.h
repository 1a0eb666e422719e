#pragma once
#include "lib/check/detail/mesh_topology.h"
#include "lib/core/triangle_source.h"

/// Checks a proxy of convex parts, as physics engines use it: the union of solids that may overlap. A part is a
/// component.
namespace bp {

/// Finds parts that are not the boundary of a convex solid facing outwards. index: the part's first triangle; other: a
/// vertex of the part that lies beyond one of its triangles. Exact, for a closed and oriented mesh whose parts do not
/// intersect themselves. O(f v) for parts of f triangles and v vertices, parallel.
[[nodiscard]] Finding nonconvex_parts(const WeldedMesh& mesh, std::size_t max_examples);

/// The report on which scene triangles the open parts cover: each point of a covered triangle lies strictly within a
/// part.
struct ConvexReport {
  std::uint64_t triangles = 0;  ///< tested triangles of the scene
  Bounds3d bounds;              ///< box of these triangles
  Finding not_held;             ///< index: scene triangle with a point that no part holds
  Finding perhaps_not_held;     ///< index: scene triangle that is neither proven to be covered nor proven to be bare
  Finding within_rounding;      ///< index: scene triangle that is covered as read, but perhaps not within its rounding
  Finding undecidable;          ///< index: scene triangle outside the domain of exact predicates
};

/// Checks that the parts cover the scene. Reads the scene once from its start; twice if the scene was rounded
/// (SceneCounts::rounding) or the proxy was, by up to `proxy_off`. Memory does not grow with the scene. The result also
/// holds for parts that are not convex, since every point below the planes of all triangles of a closed part lies
/// within it. Exact for triangles that lie within one part, and for corners that lie in none; the others are decided
/// with bounds of all rounding (convex_cover.h), or remain undecided. Time: linear in the scene, times the triangles of
/// the parts that one meets.
[[nodiscard]] ConvexReport check_convex(const WeldedMesh& mesh, TriangleSource& scene, std::size_t max_examples,
                                        double proxy_off = 0);

}  // namespace bp
