#include "lib/volume/dilate.h"

#include <algorithm>

namespace bp {

namespace {

void dilate_row(std::uint64_t* row, std::int32_t words, std::int32_t reach) {
  for (std::int32_t step = 0; step < reach; ++step) {
    std::uint64_t before = 0;  // the word to the left, as it was
    for (std::int32_t i = 0; i < words; ++i) {
      const std::uint64_t word = row[i], after = i + 1 < words ? row[i + 1] : 0;
      row[i] = word | word << 1 | word >> 1 | before >> 63 | after << 63;
      before = word;
    }
  }
}

}  // namespace

void dilate(BitBox& voxels, std::int32_t reach) {
  const VoxelBox& box = voxels.box();
  const std::int32_t words = voxels.words_per_row();
  for (const int axis : {1, 2}) {
    const BitBox before = voxels;
    for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
      for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
        const std::int32_t at = axis == 1 ? y : z;
        const std::int32_t first = std::max(box.min[axis], at - reach), last = std::min(box.max[axis] - 1, at + reach);
        std::uint64_t* row = voxels.row(y, z);
        for (std::int32_t k = first; k <= last; ++k) {
          const std::uint64_t* near = axis == 1 ? before.row(k, z) : before.row(y, k);
          for (std::int32_t i = 0; i < words; ++i) row[i] |= near[i];
        }
      }
    }
  }
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) dilate_row(voxels.row(y, z), words, reach);
  }
}

}  // namespace bp
