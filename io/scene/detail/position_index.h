#pragma once
#include <bit>
#include <vector>

#include "lib/core/coords.h"
#include "lib/core/error.h"

namespace bp {

/// Numbers positions by their exact coordinates (their bits: NaN equals itself, and -0 must have become 0). Open
/// addressing; 8 bytes a slot in addition to the positions.
class PositionIndex {
 public:
  explicit PositionIndex(std::vector<Vec3d>& positions) : positions_(positions), slots_(1024, kEmpty) {}

  /// Returns the number of `p`, appended if it is new. Throws out_of_resource beyond 2^32 - 1 positions.
  std::uint32_t add(const Vec3d& p) {
    if (2 * positions_.size() >= slots_.size()) grow();
    const std::size_t slot = find(p);
    if (slots_[slot] == kEmpty) {
      if (positions_.size() == kEmpty) fail(ErrorCode::out_of_resource, "a mesh of more than 2^32 - 1 vertices");
      slots_[slot] = std::uint32_t(positions_.size());
      positions_.push_back(p);
    }
    return slots_[slot];
  }

 private:
  static constexpr std::uint32_t kEmpty = ~std::uint32_t(0);
  using Bits = std::array<std::uint64_t, 3>;
  static Bits bits(const Vec3d& p) { return std::bit_cast<Bits>(p); }
  static std::uint64_t mix(std::uint64_t x) {  // a bijection whose high bits depend on all bits
    x = (x ^ (x >> 32)) * 0x9E3779B97F4A7C15u;
    return x ^ (x >> 29);
  }
  [[nodiscard]] std::size_t find(const Vec3d& p) const {
    const Bits b = bits(p);
    std::size_t slot = std::size_t(mix(b[0] + mix(b[1] + mix(b[2])))) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty && bits(positions_[slots_[slot]]) != b) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (std::size_t i = 0; i < positions_.size(); ++i) slots_[find(positions_[i])] = std::uint32_t(i);
  }

  std::vector<Vec3d>& positions_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace bp
