#pragma once
#include "lib/mesh/edge_limit.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/surface/piece.h"

/// Merges the flat regions of a voxel surface without changing its shape: a vertex inside a flat region, or on a
/// straight crease between two, is collapsed into a neighbour in the same plane (on the same crease). The surface as a
/// set of points stays the same, so neither a guard nor the link condition is needed: an edge that the link condition
/// would find in its way would lie in the interior of the merged faces already. Linear in the faces.
namespace bp {

/// Needs axis-aligned faces. Locked vertices stay. Returns the number of collapses.
std::uint64_t merge_flat_regions(HalfEdgeMesh& mesh, const EdgeLimit& edge_limit = {});

/// The same of a piece without quadrics, with what lies along its cell's sides locked.
void merge_flat_regions(Piece& piece, const EdgeLimit& edge_limit);

}  // namespace bp
