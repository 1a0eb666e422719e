#pragma once
#include "lib/grid/stream.h"
#include "lib/meshing/lattice_mesh.h"
#include "lib/meshing/piece.h"

/// Dense surface: the boundary of the union of voxels, as the faces between an occupied and an empty voxel, each split
/// into two triangles, counter-clockwise from outside. Exact: it contours the solid and nothing else.
namespace bp {

/// Faces of the voxels of one brick. Its rim, the vertices on the brick's border, also belongs to its neighbours.
[[nodiscard]] Piece extract_piece(const BrickShelf& shelf, BrickCoord brick);

/// Welds the pieces of all bricks. The result does not depend on threads. Closed and 2-manifold if the shelf was
/// repaired (repair.h). Cost: linear in the faces; 2 triangles per face, 12 bytes each, 24 bytes per vertex.
[[nodiscard]] LatticeMesh dense_surface(const BrickShelf& shelf, const GridFrame& frame);

}  // namespace bp
