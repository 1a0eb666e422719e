#pragma once
#include "lib/grid/bit_box.h"
#include "lib/grid/cells.h"

/// Boxes of voxels twice as large: voxel p there is the voxels 2 p to 2 p + (1, 1, 1) here.
namespace bp::detail {

/// Sets `to` (its box is kept) to the large voxels that hold something. Cost: some 20 operations for 512 voxels.
void halve(const BitBox& from, BitBox& to);

/// Sets `to` (its box is kept) to what the large voxels hold.
void double_up(const BitBox& from, BitBox& to);

}  // namespace bp::detail
