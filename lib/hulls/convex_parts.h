#pragma once
#include <vector>

#include "lib/mesh/lattice_mesh.h"

/// Convex pieces around a mesh, for physics engines that want nothing else.
namespace bp {

/// The connected components of a mesh, in the order of their first triangles; frame and provenance are the mesh's.
/// O(n log n).
[[nodiscard]] std::vector<LatticeMesh> components_of(const LatticeMesh& mesh);

struct ConvexParts {
  std::vector<LatticeMesh> hulls;  ///< closed, 2-manifold, convex; they overlap where the mesh was cut
  std::size_t solids = 0;          ///< connected parts of the mesh
  bool limited = false;            ///< as many hulls as were allowed: with more they might come nearer
  bool short_of_faces = false;     ///< all the faces that were allowed: with more they might come nearer
};
constexpr std::size_t kMostHulls = 32;    ///< default number of hulls
constexpr std::size_t kMostCorners = 64;  ///< of a hull

/// Convex hulls that together enclose, exactly, what the closed and embedded mesh encloses: whatever lies in the open
/// solid lies in the open hull of one of them. At most `most` hulls; 0: as many as there are parts, or kMostHulls if
/// that is more. Approximate convex decomposition, after [WLLS22] and [MG09]: parts are cut by planes of the axes into
/// four times as many cells, and hulls of cells are joined while there are too many, or while that costs next to
/// nothing. Corners are lattice points, at most kMostCorners a hull, and no hull has slivers (convex_shape.h). With
/// `faces`, 4 at least, all hulls together have at most so many: corners go where that adds least, and hulls are joined
/// as long as that leaves less volume. 0: as many as they like. Parallel; the same for any number of threads. Throws
/// bad_argument for a mesh that hull_of() does not take. Cost: of each cut some 40 hulls of what is cut; a level of
/// 20,000 faces takes seconds.
[[nodiscard]] ConvexParts convex_parts(const LatticeMesh& mesh, std::size_t most, std::uint64_t faces = 0);

}  // namespace bp
