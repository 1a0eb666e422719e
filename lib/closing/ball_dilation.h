#pragma once
#include "lib/closing/closing_scratch.h"
#include "lib/grid/bit_box.h"

/// Dilation by a ball, the first half of a closing, as a function of its own.
namespace bp {

/// Sets `out` (its box is kept) to the voxels p with |p - q|^2 < bound for some voxel q of `solid`, which must hold all
/// such q. bound: 1 to 2^24. Exact, in integers. Cost: detail/ball_transform.h, for the voxels between the cube in the
/// ball and the cube around it. Memory: four boxes like `out`, and one as large as everything within reach of it.
void dilate_by_ball(const BitBox& solid, std::int32_t bound, BitBox& out, ClosingScratch& scratch);

}  // namespace bp
