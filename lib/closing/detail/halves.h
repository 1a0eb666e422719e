#pragma once
#include "lib/grid/bit_box.h"
#include "lib/grid/cells.h"

/// Boxes of large voxels, twice as large: large voxel p is the voxels 2 p to 2 p + (1, 1, 1).
namespace bp::detail {

/// Sets `to` (its box is kept) to the large voxels that hold a voxel of `from`. Cost: some 20 operations for 512
/// voxels.
void halve(const BitBox& from, BitBox& to);

/// Sets `to` (its box is kept) to the voxels in the large voxels of `from`.
void double_up(const BitBox& from, BitBox& to);

}  // namespace bp::detail
