#pragma once
#include "lib/grid/bit_box.h"

namespace bp {

/// Adds every voxel within `reach` of an occupied one along each axis, in the box and its whole words. Cost: for each
/// axis log2(reach + 1) passes over the words, and a second box for a moment.
void dilate(BitBox& voxels, std::int32_t reach);
void dilate(BitBox& voxels, VoxelCoord reach);  ///< the same, with a reach for each axis

/// Adds the voxels of `within` that share a face with an occupied one. Returns whether there were any. Both have the
/// same box. Cost: one pass over the words, and a second box for a moment.
bool dilate_over_faces(const BitBox& within, BitBox& voxels);

/// Grows `seeds` within `solid`, which holds them, over faces of voxels. Afterwards `seeds` is the union of those
/// connected parts of `solid` that hold a seed. Both have the same box. Cost: sweeps over the words of the box, forth
/// and back, until nothing changes; few unless parts wind.
void grow_within(const BitBox& solid, BitBox& seeds);

}  // namespace bp
