#pragma once
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/surface/piece_store.h"

/// The start of a level of detail that encloses the level before: that level is voxelized as if it were a scene, so the
/// next one encloses it for the same reasons as the first encloses the scene (docs/bounding.md, "Levels").
namespace bp {

/// Puts the voxels that `inner`, over any diagonals of its quads, touches or encloses onto the shelf `around`,
/// repaired: their surface is closed, 2-manifold, embedded, and strictly around `inner`. Edge `voxel`, or slightly
/// more, scene units; returns their frame. Bricks wait on shelves of `make_shelf`, triangles as `memory` says: those of
/// `inner`, twice, come on top. Throws as voxelize_stream().
[[nodiscard]] GridFrame voxels_around(const LatticeMesh& inner, double voxel, const ShelfFactory& make_shelf,
                                      const PieceMemory& memory, BrickShelf& around);

/// The same on the other side, for proxies inside a solid: the dense surface of the voxels that `outer`, over every
/// choice of diagonals, encloses and does not touch, turned inwards (its solid is what surrounds it). Where no voxel
/// fits, they are halved until some do. Throws bad_input if `outer` is too thin for that, out_of_resource if the
/// surface does not fit in `memory`.
[[nodiscard]] LatticeMesh surface_within(const LatticeMesh& outer, double voxel, const ShelfFactory& make_shelf,
                                         const PieceMemory& memory);

/// The dense surface of `solid` turned inwards, after taking away voxels where the complement touches itself only along
/// edges or at corners; `around` gets the complement, in the bricks of `solid` and those around them. Returns no
/// triangle if nothing is left.
[[nodiscard]] LatticeMesh inward_surface(const BrickShelf& solid, const GridFrame& frame,
                                         const ShelfFactory& make_shelf, BrickShelf& around);
/// The voxels that are left for it.
[[nodiscard]] std::unique_ptr<BrickShelf> repaired_within(const BrickShelf& solid, const ShelfFactory& make_shelf,
                                                          BrickShelf& around);

/// Every triangle turned over.
void turn_over(LatticeMesh& mesh);

/// Triangles of a lattice mesh in scene units, exactly.
[[nodiscard]] std::vector<TriangleD> world_triangles(const LatticeMesh& mesh);
/// Those, and the triangles across each quad: all that may be drawn (quads.h).
[[nodiscard]] std::vector<TriangleD> drawable_world_triangles(const LatticeMesh& mesh);

}  // namespace bp
