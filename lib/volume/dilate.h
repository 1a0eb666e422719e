#pragma once
#include "lib/grid/bit_box.h"

namespace bp {

/// Adds every voxel within `reach` of an occupied one along each axis, in the box and its whole words. Cost: for each
/// axis log2(reach + 1) passes over the words, and a second box for a moment.
void dilate(BitBox& voxels, std::int32_t reach);

}  // namespace bp
