#pragma once
#include <vector>

#include "lib/grid/bit_box.h"

namespace bp {

/// Few boxes that hold all voxels of a set, and no other voxel of `unit` voxels a side, in which they are counted: 1,
/// or the least power of two for which `most` boxes suffice. Memory: twice the set's, and that of the boxes.
struct FewBoxes {
  std::vector<VoxelBox> boxes;
  std::int32_t unit = 1;
};
[[nodiscard]] FewBoxes few_boxes_of(BitBox voxels, std::size_t most);

}  // namespace bp
