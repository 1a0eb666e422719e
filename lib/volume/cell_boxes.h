#pragma once
#include <vector>

#include "lib/grid/bit_box.h"

namespace bp {

/// Boxes that hold all voxels of a set, and nothing else: rows of voxels, rows beside each other as plates, plates on
/// each other as boxes.
[[nodiscard]] std::vector<VoxelBox> boxes_of(BitBox voxels);

/// The same set by voxels twice as large: v lies in floor(v / 2).
[[nodiscard]] BitBox halved(const BitBox& voxels);

/// Few boxes that hold all voxels of a set, in units of `unit` voxels: 1, or the least power of two for which `most`
/// boxes suffice.
struct FewBoxes {
  std::vector<VoxelBox> boxes;
  std::int32_t unit = 1;
};
[[nodiscard]] FewBoxes few_boxes_of(BitBox voxels, std::size_t most);

}  // namespace bp
