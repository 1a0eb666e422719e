#pragma once
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/surface/piece_store.h"

/// Makes the start of a level of detail that encloses the level before. That level is voxelized like a scene, so the
/// next level encloses it for the same reasons as the first one encloses the scene (docs/bounding.md, "Levels").
namespace bp {

/// Puts the voxels that `inner` touches or encloses, with any diagonals of its quads, onto the shelf `around`, and
/// repairs them: their surface is closed, 2-manifold, embedded, and strictly around `inner`. The voxels' edge is
/// `voxel` or slightly more, scene units. Returns their frame. Bricks wait on shelves of `make_shelf`, and triangles as
/// `memory` says, in addition to two copies of the triangles of `inner`. Throws as voxelize_stream().
[[nodiscard]] GridFrame voxels_around(const LatticeMesh& inner, double voxel, const ShelfFactory& make_shelf,
                                      const PieceMemory& memory, BrickShelf& around);

/// Makes the start of a proxy inside a solid: the dense surface of the voxels that `outer` encloses and does not touch,
/// with any diagonals of its quads. It is turned inwards, since its solid is everything around it. If no voxel lies
/// inside, the voxels are halved until some do. Throws bad_input if `outer` is too thin for that, and out_of_resource
/// if the surface does not fit in `memory`.
[[nodiscard]] LatticeMesh surface_within(const LatticeMesh& outer, double voxel, const ShelfFactory& make_shelf,
                                         const PieceMemory& memory);

/// Returns the dense surface of `solid` turned inwards; no triangles if nothing is left of it. First it removes the
/// voxels where the complement touches itself only along edges or at corners. `around` gets the complement, in the
/// bricks of `solid` and those around them.
[[nodiscard]] LatticeMesh inward_surface(const BrickShelf& solid, const GridFrame& frame,
                                         const ShelfFactory& make_shelf, BrickShelf& around);
/// Returns the voxels that inward_surface() leaves of `solid`.
[[nodiscard]] std::unique_ptr<BrickShelf> repaired_within(const BrickShelf& solid, const ShelfFactory& make_shelf,
                                                          BrickShelf& around);

/// Turns over every triangle.
void turn_over(LatticeMesh& mesh);

/// Returns the triangles of a lattice mesh in scene units, exactly.
[[nodiscard]] std::vector<TriangleD> world_triangles(const LatticeMesh& mesh);
/// Returns these triangles and those across each quad: everything that may be drawn (quads.h).
[[nodiscard]] std::vector<TriangleD> drawable_world_triangles(const LatticeMesh& mesh);

}  // namespace bp
