#pragma once
#include <vector>

#include "lib/grid/bit_box.h"

namespace bp {

/// Few boxes that hold all voxels of a set. They are counted in cells of `unit` voxels a side, and hold no cell without
/// a voxel of the set. `unit` is 1, or the least power of two for which `most` boxes suffice. Memory: twice the set's,
/// and that of the boxes.
struct FewBoxes {
  std::vector<VoxelBox> boxes;
  std::int32_t unit = 1;
};
[[nodiscard]] FewBoxes few_boxes_of(BitBox voxels, std::size_t most);

}  // namespace bp
