#pragma once
#include <functional>
#include <span>

#include "lib/grid/bit_box.h"
#include "lib/voxel/fixed_triangle.h"

/// Conservative surface voxelization, exact in integers ([SS10]; lib/voxel/overlap.h).
namespace bp {

/// Sets, in `out`, every voxel whose closed cube, grown by `slack` (fixed_slack()), meets a triangle; keeps what is
/// set. Triangles may reach outside the box or lie there; coordinates must stay below 2^47 in absolute value.
/// Degenerate triangles are segments and points. On the calling thread. Cost: the voxels of a small triangle's box; for
/// a large one the rows of `out` that it crosses.
void voxelize_surface(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack = kFixedSlack);

/// Calls emit(tile) for each tile that the triangle meets, tile t being the voxels [first + t edge_vox, first + (t + 1)
/// edge_vox) grown by `slack`, among tiles [0, count). Exact for triangles up to 2^24 voxels long; beyond that it
/// may add tiles of the triangle's box.
void for_each_tile(const FixedTriangle& triangle, VoxelCoord first, std::int32_t edge_vox, TileCoord count,
                   const std::function<void(TileCoord)>& emit, std::int64_t slack = kFixedSlack);

}  // namespace bp
