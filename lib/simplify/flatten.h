#pragma once
#include "lib/mesh/edge_limit.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/surface/piece.h"

/// Merges the flat regions of a voxel surface without changing its shape: a vertex inside a flat region, or on a
/// straight crease between two, is collapsed into a neighbour in the same plane (on the same crease). The surface as a
/// set of points stays the same, so neither a guard nor the link condition is needed: an edge that would violate the
/// link condition would already lie in the interior of the merged faces. Linear in the faces.
namespace bp {

/// Merges flat regions. The faces must be axis-aligned. Locked vertices stay. Returns the number of collapses.
std::uint64_t merge_flat_regions(HalfEdgeMesh& mesh, const EdgeLimit& edge_limit = {});

/// Merges the flat regions of a piece without quadrics. Vertices on its cell's sides are locked.
void merge_flat_regions(Piece& piece, const EdgeLimit& edge_limit);

}  // namespace bp
