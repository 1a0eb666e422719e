#pragma once
#include "lib/closing/detail/closing_parts.h"

namespace bp::detail {

/// As dilate_by_ball(), by the balls of targets, of which the least has the bound `least`. `occupied`: whole words that
/// hold the voxels of `solid`. `out` may be the dilation of `parts`, but no other box of them.
void dilate_by_balls(const BitBox& solid, const VoxelBox& occupied, const BallRule& rule, std::int32_t least,
                     ClosingScratch::Parts& parts, BitBox& out);

}  // namespace bp::detail
