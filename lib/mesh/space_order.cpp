#include "lib/mesh/space_order.h"

#include <array>

namespace bp {

namespace {

/// Moves bit i of a 10-bit number to bit 3 i.
std::uint32_t spread(std::uint32_t v) {
  v = (v | (v << 16)) & 0x030000ff;
  v = (v | (v << 8)) & 0x0300f00f;
  v = (v | (v << 4)) & 0x030c30c3;
  return (v | (v << 2)) & 0x09249249;
}

}  // namespace

void SpaceOrder::set(std::size_t i, std::uint32_t item, const LatticeCoord& place) {
  const LatticeCoord c = place - low_;
  const std::uint32_t code = spread(std::uint32_t(c.x >> shift_)) | spread(std::uint32_t(c.y >> shift_)) << 1 |
                             spread(std::uint32_t(c.z >> shift_)) << 2;
  keys_[i] = std::uint64_t(code) << 32 | item;
}

/// Sorts by code, where equal codes keep their order. It is a counting sort by the bits of an axis, the least bits
/// first.
std::vector<std::uint32_t> SpaceOrder::take() {
  constexpr std::size_t kDigits = 1 << kBits;
  std::vector<std::uint64_t> sorted(keys_.size());
  for (int shift = 32; shift < 32 + 3 * kBits; shift += kBits) {
    const auto digit = [shift](std::uint64_t key) { return key >> shift & (kDigits - 1); };
    std::array<std::uint32_t, kDigits + 1> start{};
    for (const std::uint64_t k : keys_) ++start[digit(k) + 1];
    for (std::size_t i = 0; i < kDigits; ++i) start[i + 1] += start[i];
    for (const std::uint64_t k : keys_) sorted[start[digit(k)]++] = k;
    keys_.swap(sorted);
  }
  std::vector<std::uint32_t> items(keys_.size());
  std::transform(keys_.begin(), keys_.end(), items.begin(), [](std::uint64_t k) { return std::uint32_t(k); });
  return items;
}

}  // namespace bp
