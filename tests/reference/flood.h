#pragma once
#include "lib/grid/bit_box.h"

/// The definition of the flood fill: one queue over one grid, no tiles.
namespace bp::reference {

/// `solid` with every empty voxel of `grid` set that no path of 6-neighbours through empty voxels joins to the outside
/// of `grid`, which is empty.
[[nodiscard]] BitBox fill_enclosed(const BitBox& solid, const VoxelBox& grid);

}  // namespace bp::reference
