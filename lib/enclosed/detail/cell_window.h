#pragma once
#include <algorithm>
#include <bit>

#include "lib/mesh/box_group.h"

namespace bp::detail {

/// Returns a word with the bits `first` to `last` set, both included and clamped to 0 .. 7.
[[nodiscard]] inline std::uint64_t bits_between(std::int64_t first, std::int64_t last) {
  first = std::max<std::int64_t>(first, 0);
  last = std::min<std::int64_t>(last, 7);
  return first > last ? 0 : (std::uint64_t(0xff) >> (7 - last + first)) << first;
}

/// The cells of a box of 8^3 cells that the box around a tetrahedron meets: bit 8 y + x of word z.
class CellWindow {
 public:
  /// `first`: the low corner of cell (0, 0, 0); `edge`: edge of a cell.
  CellWindow(const LatticeBox& box, const LatticeCoord& first, std::int64_t edge) {
    const auto low = [&](int i) { return floor_div(box.min[i] - first[i], edge); };
    const auto high = [&](int i) { return floor_div(box.max[i] - 1 - first[i], edge); };
    const std::uint64_t columns = bits_between(low(0), high(0));
    for (std::uint64_t y = bits_between(low(1), high(1)); y != 0; y &= y - 1)
      word_ |= columns << (8 * std::countr_zero(y));
    low_z_ = std::max<std::int64_t>(low(2), 0);
    high_z_ = std::min<std::int64_t>(high(2), 7);
  }
  [[nodiscard]] std::int64_t low_z() const { return low_z_; }
  [[nodiscard]] std::int64_t high_z() const { return high_z_; }  ///< included
  [[nodiscard]] std::uint64_t word() const { return word_; }     ///< the same word for each z between

 private:
  std::int64_t low_z_, high_z_;
  std::uint64_t word_ = 0;
};

}  // namespace bp::detail
