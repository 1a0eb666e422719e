#pragma once
#include "lib/core/memory_share.h"
#include "lib/grid/mirror_plane.h"
#include "lib/grid/stream.h"

namespace bp {

/// Adds the mirror image of `voxels` to `out`. Cost: each voxel once.
void add_mirrored(const BrickShelf& voxels, const MirrorPlane& plane, BrickShelf& out);

/// Returns whether the mirror image of each voxel is nearer to some voxel than `reach`, cube to cube, in voxels. Cost
/// and memory: dilate_ball() and add_mirrored().
[[nodiscard]] bool is_symmetric(const BrickShelf& voxels, const MirrorPlane& plane, double reach,
                                const ShelfFactory& make_shelf, const MemoryShare& memory = {});

}  // namespace bp
