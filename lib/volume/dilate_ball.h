#pragma once
#include <functional>

#include "lib/core/memory_share.h"
#include "lib/grid/stream.h"

namespace bp {

/// Puts on `out` every voxel whose closed cube is nearer than `reach`, in voxels, to the closed cube of an occupied
/// one, but for the rounding of reach * reach; and these. So any point nearer than `reach` to a point of an occupied
/// cube lies in the open interior of the result, if the caller makes `reach` larger by that. `out` is empty before.
/// `reach`: 0 to kMostReach. Parallel; neither threads nor memory change the result. Memory: `memory`, for tiles at
/// work; throws out_of_resource if not even one brick fits with what is in reach of it. Cost: dilate_by_ball() of
/// tiles, which are as large as fits. progress(done, total): tiles; may be empty.
void dilate_ball(const BrickShelf& voxels, double reach, BrickShelf& out, const MemoryShare& memory = {},
                 const std::function<void(std::uint64_t, std::uint64_t)>& progress = {});
constexpr double kMostReach = 512;

}  // namespace bp
