#pragma once
#include "lib/closing/detail/closing_parts.h"

namespace bp::detail {

/// Does what dilate_by_ball() does, by balls of the targets; the least ball has the bound `least`. `occupied`: a box of
/// whole words that holds the voxels of `solid`. `out` may be the dilation of `parts`, but no other box of them.
void dilate_by_balls(const BitBox& solid, const VoxelBox& occupied, const BallRule& rule, std::int32_t least,
                     ClosingScratch::Parts& parts, BitBox& out);

}  // namespace bp::detail
