#pragma once
#include <optional>

#include "lib/grid/mirror_plane.h"
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"

/// A surface of nothing but quads around voxels: the boundary of large cells that hold them.
namespace bp {

struct CellQuads {
  LatticeMesh mesh;                 ///< its `quads` are all of its triangles
  std::vector<std::uint32_t> mate;  ///< of each vertex: its mirror image, itself in the plane; empty without a plane
};

/// The boundary of boxes between planes across the axes that hold all `voxels`, repaired, without hollows: closed,
/// 2-manifold, embedded, with at most `faces` triangles. It begins with some 40 planes along the longest side; then
/// planes go that add the least volume for the faces that they save. With a mirror plane the result is its own mirror
/// image, and holds that of the voxels. No triangles if `faces` is below 12, or below 20 with a plane. Deterministic.
/// Cost: reading the voxels, and a second for all the planes that may go.
[[nodiscard]] CellQuads cell_quads(const BrickShelf& voxels, const GridFrame& frame, std::uint64_t faces,
                                   const std::optional<MirrorPlane>& plane);

}  // namespace bp
