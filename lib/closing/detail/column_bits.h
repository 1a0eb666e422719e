#pragma once
#include <span>

#include "lib/grid/bit_box.h"

/// A box of voxels as bits, stored column by column: all words that cover the same 64 x lie together, y fastest, then
/// z. The ball transforms work on one such column at a time. In a BitBox they would fetch each cache line once per
/// column.
namespace bp::detail {

class ColumnBits {
 public:
  /// Sets the box, whose x must be whole words. Contents are undefined until written; the allocation is kept.
  void reset(const VoxelBox& box) {
    box_ = box;
    if (box.empty()) box_.max = box_.min;
    height_ = box_.max.y - box_.min.y;
    depth_ = box_.max.z - box_.min.z;
    const std::size_t words = std::size_t(columns()) * std::size_t(height_) * std::size_t(depth_);
    if (words_.size() < words) words_.resize(words);
  }
  [[nodiscard]] const VoxelBox& box() const { return box_; }
  [[nodiscard]] std::int32_t columns() const { return (box_.max.x - box_.min.x) / 64; }
  /// Returns the words (column, min.y .. max.y, z), one after the other.
  [[nodiscard]] std::uint64_t* slice(std::int32_t column, std::int32_t z) { return &words_[index(column, z)]; }
  [[nodiscard]] const std::uint64_t* slice(std::int32_t column, std::int32_t z) const {
    return &words_[index(column, z)];
  }
  /// Returns the number of words from one column to the next, at the same y and z.
  [[nodiscard]] std::size_t column_stride() const { return std::size_t(depth_) * std::size_t(height_); }

 private:
  [[nodiscard]] std::size_t index(std::int32_t column, std::int32_t z) const {
    return (std::size_t(column) * std::size_t(depth_) + std::size_t(z - box_.min.z)) * std::size_t(height_);
  }
  VoxelBox box_;
  std::int32_t height_ = 0, depth_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace bp::detail
