#pragma once
#include <vector>

#include "lib/hulls/convex_hull.h"
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
constexpr std::size_t kMostHulls = 32, kMostLooseHulls = 64;  ///< default numbers of hulls
constexpr std::size_t kMostCorners = 64;                      ///< of a hull: what physics engines take

struct HullLimits {
  std::size_t hulls = 0;    ///< at most; 0: kMostHulls, or kMostLooseHulls where those hold clearly less, or one a part
  std::uint64_t faces = 0;  ///< of all together, 4 at least; 0: as many as they like
  /// Instead, where so many leave hulls that hold half as much again as the mesh, and these hold clearly less; 0: no.
  std::uint64_t loose_faces = 0;
  std::size_t corners = kMostCorners;  ///< of a hull, 8 at least
};

/// Convex hulls that together enclose, exactly, what the closed and embedded mesh encloses: whatever lies in the open
/// solid lies in the open hull of one of them. Approximate convex decomposition, after [WLLS22] and [MG09]: parts are
/// cut by planes of the axes into four times as many cells, and hulls of cells are joined while there are too many, or
/// while that costs next to nothing. Corners are lattice points, and no hull has slivers (convex_shape.h). To keep to
/// the faces, corners go where that adds least, and hulls are joined as long as that leaves less volume.
///   given  hulls of parts that the mesh does not hold, in its frame (convex_scene.h): they stay as they are, unless
///          there are too many hulls or faces; the mesh may be empty then
/// Parallel; the same for any number of threads. Throws bad_argument for a mesh that hull_of() does not take. Cost: of
/// each cut some 40 to 120 hulls of what is cut; a level of 20,000 faces takes seconds.
[[nodiscard]] ConvexParts convex_parts(const LatticeMesh& mesh, const HullLimits& limits = {},
                                       const std::vector<ConvexHull>& given = {});

/// The number of hulls that limits of 0 lead to for a mesh of so many parts, before a second one is tried.
[[nodiscard]] std::size_t most_hulls(const HullLimits& limits, std::size_t parts);
/// More given hulls than this would all be joined with others.
[[nodiscard]] std::size_t most_given(std::size_t hulls);
/// Sum of the volumes of the hulls, scene units cubed.
[[nodiscard]] double volume_of(const ConvexParts& parts);

}  // namespace bp
