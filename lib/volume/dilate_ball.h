#pragma once
#include <functional>

#include "lib/core/memory_share.h"
#include "lib/grid/stream.h"

namespace bp {

/// Puts on `out` all occupied voxels, and every voxel whose closed cube is nearer than `reach`, in voxels, to the
/// closed cube of an occupied one, up to the rounding of reach * reach. So any point nearer than `reach` to a point of
/// an occupied cube lies in the open interior of the result, if the caller adds that rounding to `reach`. `out` is
/// empty before. `reach`: 0 to kMostReach. Parallel; neither threads nor memory change the result. `memory` is for
/// tiles at work. Throws out_of_resource if not even one brick fits, with everything in reach of it. Cost:
/// dilate_by_ball() of tiles, which are as large as fits. progress(done, total) counts tiles; it may be empty.
void dilate_ball(const BrickShelf& voxels, double reach, BrickShelf& out, const MemoryShare& memory = {},
                 const std::function<void(std::uint64_t, std::uint64_t)>& progress = {});
constexpr double kMostReach = 512;

}  // namespace bp
