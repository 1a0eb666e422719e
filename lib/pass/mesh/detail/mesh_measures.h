#pragma once
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/mesh/mesh_measures.h"

namespace bp {

/// Adds the distances to the surface of what `mesh` encloses; `tree` is over the same triangles.
void measure_distances(const LatticeMesh& mesh, const std::vector<TriangleD>& enclosed, const TriangleBvh& tree,
                       MeshMeasures& measures);

}  // namespace bp
