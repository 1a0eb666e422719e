#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/mesh/box_group.h"

/// Orders things along a space-filling curve, so that neighbours in space are near each other.
namespace bp {

/// A Morton curve of 2^10 steps an axis. Things in one step keep their order.
class SpaceOrder {
 public:
  /// Takes n things; `all` is a box around all places.
  SpaceOrder(std::size_t n, const LatticeBox& all) : low_(all.min), keys_(n) {
    const LatticeCoord size = all.max - all.min;
    shift_ = std::max(0, int(std::bit_width(std::uint64_t(std::max({size.x, size.y, size.z})))) - kBits);
  }
  /// Sets the i-th thing. Thread-safe for different i.
  void set(std::size_t i, std::uint32_t item, const LatticeCoord& place);
  /// Returns the items in order. Linear.
  [[nodiscard]] std::vector<std::uint32_t> take();

 private:
  static constexpr int kBits = 10;  // per axis
  LatticeCoord low_;
  int shift_;
  std::vector<std::uint64_t> keys_;  // codes; the low 32 bits have the items
};

/// Orders the items item(i) for i in [0, n). Parallel: it asks for places on several threads.
template <class Item, class Place>
[[nodiscard]] std::vector<std::uint32_t> space_order(std::size_t n, const Item& item, const Place& place) {
  constexpr std::int64_t kAtOnce = 1 << 14;
  if (n == 0) return {};
  std::vector<LatticeBox> boxes(n / std::size_t(kAtOnce) + 1, {place(item(0)), place(item(0))});
  const auto for_each_part = [&](const auto& body) {
    parallel_ranges(std::int64_t(n), kAtOnce, [&](std::int64_t begin, std::int64_t end) {
      body(boxes[std::size_t(begin / kAtOnce)], std::size_t(begin), std::size_t(end));
    });
  };
  for_each_part([&](LatticeBox& box, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) box.add(place(item(i)));
  });
  for (const LatticeBox& box : boxes) {
    boxes[0].add(box.min);
    boxes[0].add(box.max);
  }
  SpaceOrder order(n, boxes[0]);
  for_each_part([&](const LatticeBox&, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) order.set(i, item(i), place(item(i)));
  });
  return order.take();
}

/// Orders the numbers 0 to n - 1 by place(i).
template <class Place>
[[nodiscard]] std::vector<std::uint32_t> space_order(std::size_t n, const Place& place) {
  return space_order(
      n, [](std::size_t i) { return std::uint32_t(i); }, place);
}

}  // namespace bp
