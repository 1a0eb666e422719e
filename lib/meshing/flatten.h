#pragma once
#include "lib/meshing/half_edge_mesh.h"

/// Merges the flat regions of a voxel surface without changing its shape: a vertex inside a flat region, or on a
/// straight crease between two, is collapsed into a neighbour in the same plane (on the same crease). The surface as a
/// set of points stays the same, so no guard is needed. Linear in the faces. Needs axis-aligned faces.
namespace bp {

/// Returns the number of collapses.
std::uint64_t merge_flat_regions(HalfEdgeMesh& mesh);

}  // namespace bp
