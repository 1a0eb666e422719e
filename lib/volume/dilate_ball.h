#pragma once
#include "lib/grid/stream.h"

namespace bp {

/// Puts on `out` every voxel whose closed cube is nearer than `reach`, in voxels, to the closed cube of an occupied
/// one, but for the rounding of reach * reach; and these. So any point nearer than `reach` to a point of an occupied
/// cube lies in the open interior of the result, if the caller makes `reach` larger by that. `out` is empty before.
/// Parallel. Cost: (2 reach + 1)^2 passes over the words of each brick that is reached; memory: a brick and what is
/// around it, for each thread. `reach`: 0 to kMostReach.
void dilate_ball(const BrickShelf& voxels, double reach, BrickShelf& out);
constexpr double kMostReach = 512;

}  // namespace bp
