#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "lib/mesh/box_group.h"

/// Things in the order of a space-filling curve: those near in space are near each other.
namespace bp {

/// Along a Morton curve of 2^10 steps an axis; what lies in one step keeps its order.
class SpaceOrder {
 public:
  /// `all`: around all places.
  explicit SpaceOrder(const LatticeBox& all) : low_(all.min) {
    const LatticeCoord size = all.max - all.min;
    shift_ = std::max(0, int(std::bit_width(std::uint64_t(std::max({size.x, size.y, size.z})))) - kBits);
  }
  void reserve(std::size_t n) { keys_.reserve(n); }
  void add(std::uint32_t item, const LatticeCoord& place);
  /// The items. Linear.
  [[nodiscard]] std::vector<std::uint32_t> take();

 private:
  static constexpr int kBits = 10;  // per axis
  LatticeCoord low_;
  int shift_;
  std::vector<std::uint64_t> keys_;  // codes and, in the low 32 bits, their items
};

/// Of place(i) for i in [0, n).
template <class Place>
[[nodiscard]] std::vector<std::uint32_t> space_order(std::size_t n, const Place& place) {
  if (n == 0) return {};
  LatticeBox all{place(0), place(0)};
  for (std::uint32_t i = 0; i < n; ++i) all.add(place(i));
  SpaceOrder order(all);
  order.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) order.add(i, place(i));
  return order.take();
}

}  // namespace bp
