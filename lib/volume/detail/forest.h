#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace bp::detail {

/// Union-find over small integers; the root of a set is its smallest member, so numbering follows the scan.
class Forest {
 public:
  std::uint32_t add() {
    parent_.push_back(std::uint32_t(parent_.size()));
    return parent_.back();
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
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

}  // namespace bp::detail
