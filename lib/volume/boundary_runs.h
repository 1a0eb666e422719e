#pragma once
#include <vector>

#include "lib/grid/stream.h"

/// The boundary voxels of a solid (occupied, with an empty 6-neighbour) as runs along x: a compact stand-in for the
/// surface that lies in them.
namespace bp {

/// Triangles of the dense surface for the area of a voxel's face: two for each face, and the faces of a slanted plane's
/// voxels have 1.5 times its area, on average over angles.
constexpr double kDensePerArea = 3;

/// Returns true if the brick and its six neighbours are full. Then it has no boundary voxel.
[[nodiscard]] bool is_buried(const BrickShelf& solid, BrickCoord brick);

struct VoxelRun {
  VoxelCoord first;         ///< lowest in x
  std::int32_t length = 0;  ///< voxels, within one brick
  friend bool operator==(const VoxelRun&, const VoxelRun&) = default;
};

struct Boundary {
  std::vector<VoxelRun> runs;  ///< by brick (x, y, z), then z, y, x
  std::uint64_t faces = 0;  ///< faces between an occupied and an empty voxel: half the triangles of the dense surface
};

/// Returns the boundary voxels. Parallel; the result depends on the voxels alone. Cost: linear in the bricks, 16 bytes
/// a run, twice for a moment.
[[nodiscard]] Boundary boundary_of(const BrickShelf& solid);

/// How many runs and faces boundary_of() would return, and the box around their voxels: counted without making them.
struct BoundarySize {
  std::uint64_t runs = 0, faces = 0;
  VoxelBox box{};  ///< around the boundary voxels
};
[[nodiscard]] BoundarySize boundary_size(const BrickShelf& solid);

/// Returns the number of voxels of a solid. Parallel.
[[nodiscard]] std::uint64_t count_voxels(const BrickShelf& solid);

/// Returns the number of faces between an occupied voxel of `brick` and an empty one, there or in the next brick.
[[nodiscard]] std::uint64_t boundary_faces(const BrickShelf& solid, BrickCoord brick);

/// Puts the boundary voxels of `solid` on a shelf of their own. Parallel.
void boundary_layer(const BrickShelf& solid, BrickShelf& boundary);

/// Returns the voxels of `shelf` that lie in `box`, as runs, ordered by brick (z, y, x), then by z, y, x.
[[nodiscard]] std::vector<VoxelRun> runs_of(const BrickShelf& shelf, const VoxelBox& box);
[[nodiscard]] std::uint64_t count_runs(const BrickShelf& shelf, const VoxelBox& box);  ///< number of runs of runs_of()

}  // namespace bp
