#pragma once
#include <vector>

#include "lib/hulls/convex_hull.h"
#include "lib/mesh/lattice_mesh.h"

/// Convex pieces around a mesh, for physics engines that take nothing else.
namespace bp {

/// Returns the connected components of a mesh, in the order of their first triangles. Frame and provenance are the
/// mesh's. O(n log n).
[[nodiscard]] std::vector<LatticeMesh> components_of(const LatticeMesh& mesh);

struct ConvexParts {
  std::vector<LatticeMesh> hulls;  ///< closed, 2-manifold, convex; they overlap where the mesh was cut
  std::size_t solids = 0;          ///< connected parts of the mesh
  bool limited = false;            ///< the hulls are as many as were allowed; with more they might come nearer
  bool short_of_faces = false;     ///< all allowed faces are used; with more they might come nearer
};
constexpr std::size_t kMostHulls = 32, kMostLooseHulls = 64;  ///< default numbers of hulls
constexpr std::size_t kMostCorners = 64;                      ///< of a hull: physics engines take so many

struct HullLimits {
  /// The most hulls; 0: kMostHulls, or kMostLooseHulls if these hold clearly less, or one for each part.
  std::size_t hulls = 0;
  std::uint64_t faces = 0;  ///< of all hulls together, 4 at least; 0: no limit
  /// The faces instead, if `faces` leaves hulls that hold half as much again as the mesh, and these hold clearly less;
  /// 0: not tried.
  std::uint64_t loose_faces = 0;
  std::size_t corners = kMostCorners;  ///< of a hull, 8 at least
};

/// Returns convex hulls that together enclose, exactly, what the closed and embedded mesh encloses: each point of the
/// open solid lies in the open hull of one of them. It is an approximate convex decomposition, after [WLLS22] and
/// [MG09]. Planes of the axes cut parts into four times as many cells. Hulls of cells are joined while there are too
/// many, or while that costs next to nothing. Corners are lattice points, and no hull has slivers (convex_shape.h). To
/// keep to the faces, corners go where that adds least, and hulls are joined as long as that leaves less volume.
///   given  hulls of parts that the mesh does not hold, in its frame (convex_scene.h). They stay as they are, unless
///          there are too many hulls or faces. The mesh may be empty then
/// Parallel; the same for any number of threads. Throws bad_argument for a mesh that hull_of() does not take. Cost:
/// some 40 to 120 hulls for each cut; a level of 20,000 faces takes seconds.
[[nodiscard]] ConvexParts convex_parts(const LatticeMesh& mesh, const HullLimits& limits = {},
                                       const std::vector<ConvexHull>& given = {});

/// Returns the number of hulls that limits of 0 lead to for a mesh of so many parts, before a second number is tried.
[[nodiscard]] std::size_t most_hulls(const HullLimits& limits, std::size_t parts);
/// Returns how many given hulls make sense: with more, all would be joined with others.
[[nodiscard]] std::size_t most_given(std::size_t hulls);
/// Returns the sum of the volumes of the hulls, scene units cubed.
[[nodiscard]] double volume_of(const ConvexParts& parts);

}  // namespace bp
