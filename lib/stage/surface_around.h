#pragma once
#include "lib/grid/stream.h"
#include "lib/meshing/lattice_mesh.h"

/// The start of a level of detail that encloses the level before: that level is voxelized as if it were a scene, so the
/// next one encloses it for the same reasons as the first encloses the scene (docs/bounding.md, "Levels").
namespace bp {

/// The dense surface of the voxels that `inner` touches or encloses, of edge `voxel` (or slightly more, scene units):
/// closed, 2-manifold, embedded, strictly around `inner`, in a frame of its own. Bricks wait on shelves of
/// `make_shelf`. Throws as voxelize_stream() and dense_surface().
[[nodiscard]] LatticeMesh surface_around(const LatticeMesh& inner, double voxel, const ShelfFactory& make_shelf);

/// Triangles of a lattice mesh in scene units, exactly.
[[nodiscard]] std::vector<TriangleD> world_triangles(const LatticeMesh& mesh);

}  // namespace bp
