#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace bp {

/// Union-find over small integers. The root of a set is its smallest member, so numbering follows the scan.
class DisjointSets {
 public:
  /// Sets of one member each.
  explicit DisjointSets(std::size_t members = 0) : parent_(members) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
  }
  /// One more set of one member, which is returned.
  std::uint32_t add() {
    parent_.push_back(std::uint32_t(parent_.size()));
    return parent_.back();
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// True if these were two sets.
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// Afterwards parent(i) is the root of i.
  void flatten() {
    for (std::uint32_t& p : parent_) p = parent_[p];  // parents come first
  }
  [[nodiscard]] std::uint32_t parent(std::uint32_t i) const { return parent_[i]; }
  [[nodiscard]] std::uint32_t size() const { return std::uint32_t(parent_.size()); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace bp
