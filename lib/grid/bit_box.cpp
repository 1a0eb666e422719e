#include "lib/grid/bit_box.h"

#include <cstring>

#include "lib/grid/count_bits.h"

namespace bp {

void BitBox::reset(const VoxelBox& box) {
  box_ = box;
  box_.min.x = floor_div(box.min.x, 64) * 64;
  box_.max.x = ceil_div(box.max.x, 64) * 64;
  if (box.empty()) box_.max = box_.min;
  words_per_row_ = (box_.max.x - box_.min.x) / 64;
  words_.assign(
      std::size_t(words_per_row_) * std::size_t(box_.max.y - box_.min.y) * std::size_t(box_.max.z - box_.min.z), 0);
}

std::uint64_t BitBox::count() const {
  return count_bits(std::as_bytes(std::span(words_)));
}

void copy_voxels(const BitBox& from, BitBox& to) {
  const VoxelBox both = intersect(from.box(), to.box());
  if (both.empty()) return;
  const std::size_t bytes = std::size_t(both.max.x - both.min.x) / 8;
  for (std::int32_t z = both.min.z; z < both.max.z; ++z) {
    for (std::int32_t y = both.min.y; y < both.max.y; ++y) {
      std::memcpy(to.row(y, z) + (both.min.x - to.box().min.x) / 64,
                  from.row(y, z) + (both.min.x - from.box().min.x) / 64, bytes);
    }
  }
}

}  // namespace bp
