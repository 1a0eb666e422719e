#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace bp {

/// Union-find over small integers. The root of a set is its smallest member, so numbering follows the scan.
class DisjointSets {
 public:
  /// Makes sets of one member each.
  explicit DisjointSets(std::size_t members = 0) : parent_(members) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
  }
  /// Adds a set of one member, and returns that member.
  std::uint32_t add() {
    parent_.push_back(std::uint32_t(parent_.size()));
    return parent_.back();
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Unites the sets of both members. Returns false if they were in one set already.
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// Makes parent(i) the root of i for every i.
  void flatten() {
    for (std::uint32_t& p : parent_) p = parent_[p];  // parents come first
  }
  [[nodiscard]] std::uint32_t parent(std::uint32_t i) const { return parent_[i]; }
  [[nodiscard]] std::uint32_t size() const { return std::uint32_t(parent_.size()); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace bp
