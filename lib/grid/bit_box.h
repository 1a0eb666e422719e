#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/box.h"

/// A dense box of voxels as bits, the working set of a tile. It has one layout on host and device.
namespace bp {

/// Voxels lie x fastest, 64 to a word: bit i of a word is voxel x0 + i, so the 32-bit view is little-endian, too. Rows
/// have whole words and are ordered by y, then z. The box is aligned to words: min.x and max.x are multiples of 64.
/// Voxels outside are empty.
class BitBox {
 public:
  BitBox() = default;
  /// Makes an empty box. Grows `box` to whole words in x.
  explicit BitBox(const VoxelBox& box) { reset(box); }
  void reset(const VoxelBox& box);  ///< makes it like a new one, but keeps the allocation

  [[nodiscard]] const VoxelBox& box() const { return box_; }
  [[nodiscard]] std::int32_t words_per_row() const { return words_per_row_; }
  [[nodiscard]] std::int64_t word_count() const { return std::int64_t(words_.size()); }
  [[nodiscard]] std::uint64_t* data() { return words_.data(); }
  [[nodiscard]] const std::uint64_t* data() const { return words_.data(); }

  /// Returns the first word of the row of voxels (min.x .. max.x, y, z).
  [[nodiscard]] std::uint64_t* row(std::int32_t y, std::int32_t z) { return words_.data() + row_index(y, z); }
  [[nodiscard]] const std::uint64_t* row(std::int32_t y, std::int32_t z) const {
    return words_.data() + row_index(y, z);
  }

  [[nodiscard]] bool test(VoxelCoord p) const {
    if (!box_.contains(p)) return false;
    const std::int32_t i = p.x - box_.min.x;
    return (row(p.y, p.z)[i >> 6] >> (i & 63)) & 1;
  }
  void set(VoxelCoord p) {
    const std::int32_t i = p.x - box_.min.x;
    row(p.y, p.z)[i >> 6] |= std::uint64_t(1) << (i & 63);
  }
  void clear(VoxelCoord p) {
    const std::int32_t i = p.x - box_.min.x;
    row(p.y, p.z)[i >> 6] &= ~(std::uint64_t(1) << (i & 63));
  }
  [[nodiscard]] std::uint64_t count() const;  ///< number of occupied voxels
  friend bool operator==(const BitBox&, const BitBox&) = default;

 private:
  [[nodiscard]] std::int64_t row_index(std::int32_t y, std::int32_t z) const {
    return (std::int64_t(z - box_.min.z) * (box_.max.y - box_.min.y) + (y - box_.min.y)) * words_per_row_;
  }
  VoxelBox box_;
  std::int32_t words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
};

/// Copies the voxels that both boxes hold, overwriting `to`. Both are aligned to words, so nothing is shifted.
void copy_voxels(const BitBox& from, BitBox& to);

}  // namespace bp
