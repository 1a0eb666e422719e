#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "lib/closing/rotation.h"

/// A turned cube as a set of voxels: its rows.
namespace bp::detail {

/// Returns whether the cube is turned about this axis alone. Then its slices across the axis are all the same, from
/// -cube_radius() to cube_radius().
[[nodiscard]] bool keeps_axis(const Rotation& r, int axis);

/// The voxels of a row, from x = `first` to `last`; none if last < first.
struct CubeRow {
  std::int16_t first, last;
};

/// All rows of the voxels (x, dy, dz) of a turned cube around (0, 0, 0). The rows of a slice are made when they are
/// first wanted.
class CubeRows {
 public:
  static constexpr std::int32_t kEdge = 4;  ///< a block is rows [4 i, 4 i + 4) of slices [4 j, 4 j + 4)

  /// `rotation` is canonical. `flat`: 1 makes only the rows with dy = 0, 2 only those with dz = 0. Cost: a few
  /// divisions for each block.
  CubeRows(const Rotation& rotation, Scale s, int flat = -1);

  [[nodiscard]] std::int32_t reach() const { return reach_; }

  /// Consecutive rows; the first has number `begin`.
  struct Stretch {
    std::int32_t begin = 0, end = 0;
    const CubeRow* rows = nullptr;
  };
  /// Returns the rows dy in [begin, end) of slice dz, |dz| <= reach(), that have voxels.
  [[nodiscard]] Stretch rows(std::int32_t dz, std::int32_t begin, std::int32_t end) const {
    const Filled& slice = slices_[std::size_t(dz + reach_)];
    if (slice.end < slice.begin) make_slice(dz);
    begin = std::max(begin, slice.begin - reach_);
    end = std::min(end, slice.end - reach_);
    return {begin, end, row(dz) + begin};
  }
  /// Returns the blocks of slices [4 j, 4 j + 4), from the first to the last one with voxels. A block's row holds what
  /// any of its rows holds, and perhaps some more.
  [[nodiscard]] Stretch blocks(std::int32_t j) const {
    const std::int32_t layer = j - first_block_;
    if (layer < 0 || layer >= across_) return {};
    const Filled& f = layers_[std::size_t(layer)];
    return {first_block_ + f.begin, first_block_ + f.end, blocks_.data() + layer * across_ + f.begin};
  }

  [[nodiscard]] std::size_t bytes() const {
    return (rows_.size() + blocks_.size()) * sizeof(CubeRow) + (slices_.size() + layers_.size()) * sizeof(Filled);
  }
  /// Returns the largest size of any cube of this reach.
  static constexpr std::size_t most_bytes(std::int32_t reach) {
    const auto side = std::size_t(2 * reach + 1), across = side / kEdge + 2;
    return (side * side + across * across) * sizeof(CubeRow) + (side + across) * sizeof(Filled);
  }

 private:
  /// A range of rows or blocks with voxels. If end < begin, they are not made yet.
  struct Filled {
    std::int16_t begin = 1, end = 0;
  };
  /// Returns row 0 of a slice.
  [[nodiscard]] CubeRow* row(std::int32_t dz) const { return rows_.data() + (dz + reach_) * (2 * reach_ + 1) + reach_; }
  void make_slice(std::int32_t dz) const;
  [[nodiscard]] CubeRow block(std::int32_t i, std::int32_t j) const;

  Rotation rotation_;
  std::int32_t limit_, reach_;
  int flat_;
  std::int32_t first_block_, across_;  ///< the least i and j, and the number of i
  mutable std::vector<CubeRow> rows_;  ///< by slice, then dy: all rows within reach
  mutable std::vector<Filled> slices_;
  std::vector<CubeRow> blocks_;  ///< by j, then i
  std::vector<Filled> layers_;
};

}  // namespace bp::detail
