#pragma once
#include <vector>

#include "lib/meshing/lattice_mesh.h"

/// Convex pieces around a mesh, for physics engines that want nothing else.
namespace bp {

/// The connected components of a mesh, in the order of their first triangles; frame and provenance are the mesh's.
[[nodiscard]] std::vector<LatticeMesh> components_of(const LatticeMesh& mesh);

/// The convex hull of the vertices, as triangles facing outwards: closed, 2-manifold, and exact, since its corners are
/// lattice points of the mesh. It encloses what the mesh encloses. Incremental: O(n f) for n vertices and f faces of
/// the hull. Throws bad_argument if all vertices lie in a plane.
[[nodiscard]] LatticeMesh convex_hull(const LatticeMesh& mesh);

}  // namespace bp
