#pragma once
#include <vector>

#include "lib/atlas/chart.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Cuts all triangles of a mesh into charts. The faces of a chart are joined by edges, lie within about 60 degrees of a
/// direction, and are seen along it. A length in a chart is at least a quarter of that on the mesh, mostly three
/// quarters or more. Deterministic; O(n log n) for faces of about one size; 300 bytes a face.
[[nodiscard]] std::vector<Chart> cut_charts(const LatticeMesh& mesh);

}  // namespace bp
