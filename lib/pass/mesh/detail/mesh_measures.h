#pragma once
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/mesh/mesh_measures.h"

namespace bp {

/// Measures the distances between `mesh` and the surface that it encloses. `tree` is over the triangles of `enclosed`.
void measure_distances(const LatticeMesh& mesh, const std::vector<TriangleD>& enclosed, const TriangleBvh& tree,
                       MeshMeasures& measures);

}  // namespace bp
