#pragma once
#include <optional>

#include "lib/grid/mirror_plane.h"
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"

/// Cages whose faces are all quads: the boundary of large cells that hold the voxels.
namespace bp {

struct CellQuads {
  LatticeMesh mesh;  ///< its `quads` are all of its triangles
  /// Per vertex: its mirror image, or itself if it lies in the plane; empty without a plane.
  std::vector<std::uint32_t> mate;
};

/// Makes a cage of at most `faces` triangles: the boundary of a grid of boxes that hold all `voxels`, repaired, without
/// hollows; closed, 2-manifold, embedded. The grid begins with some 40 planes along the longest side; then the planes
/// that add the least volume for the faces that they save are removed. With a mirror plane the result is its own mirror
/// image and holds the voxels and their mirror image. Returns no triangles if `faces` is below 12, or below 20 with a
/// plane. Deterministic. Cost: reading the voxels, and about a second for choosing the planes.
[[nodiscard]] CellQuads cell_quads(const BrickShelf& voxels, const GridFrame& frame, std::uint64_t faces,
                                   const std::optional<MirrorPlane>& plane);

/// Makes the boundary of cubes that hold all `voxels`, repaired, without hollows. A cube has `units` 128ths of the
/// longest side. With a mirror plane the result is its own mirror image and holds the voxels and their mirror image.
[[nodiscard]] CellQuads cube_quads(const BrickShelf& voxels, const GridFrame& frame, std::int32_t units,
                                   const std::optional<MirrorPlane>& plane);

}  // namespace bp
