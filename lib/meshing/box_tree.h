#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/coords.h"

/// A bounding volume hierarchy over boxes of lattice points: the broad phase of all exact tests.
namespace bp {

/// Closed box of lattice points.
struct LatticeBox {
  LatticeCoord min{}, max{};
  [[nodiscard]] bool meets(const LatticeBox& b) const {
    return min.x <= b.max.x && b.min.x <= max.x && min.y <= b.max.y && b.min.y <= max.y && min.z <= b.max.z &&
           b.min.z <= max.z;
  }
  /// Strictly inside: not on the boundary.
  [[nodiscard]] bool holds_inside(const LatticeCoord& p) const {
    return min.x < p.x && p.x < max.x && min.y < p.y && p.y < max.y && min.z < p.z && p.z < max.z;
  }
  [[nodiscard]] bool holds(const LatticeBox& b) const {
    return min.x <= b.min.x && b.max.x <= max.x && min.y <= b.min.y && b.max.y <= max.y && min.z <= b.min.z &&
           b.max.z <= max.z;
  }
  void add(const LatticeCoord& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
};
[[nodiscard]] inline LatticeBox box_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  LatticeBox box{a, a};
  box.add(b);
  box.add(c);
  return box;
}

class BoxTree {
 public:
  /// Item i has the box boxes[i]; only those listed in `items` are in the tree. O(n log n).
  void build(std::span<const LatticeBox> boxes, std::vector<std::uint32_t> items);
  /// A changed item: its own box is exact again, those above it only grow, build() makes them tight. O(depth).
  void update(std::uint32_t item, const LatticeBox& box);
  [[nodiscard]] std::size_t size() const { return order_.size(); }

  /// visit(item) for every item whose box meets `box`; stops when visit returns false, and returns false then.
  template <class Visit>
  bool query(const LatticeBox& box, Visit&& visit) const {
    return query(
        box, [](const LatticeBox&) { return true; }, visit);
  }
  /// The same, without the subtrees whose box keep(box) refuses. Boxes beyond 2^31 lattice units of the first item are
  /// clamped, so `keep` must be for boxes within.
  template <class Keep, class Visit>
  bool query(const LatticeBox& box, Keep&& keep, Visit&& visit) const {
    if (nodes_.empty()) return true;
    const SmallBox small = to_small(box);
    std::uint32_t stack[64];
    int top = 0;
    if (nodes_[0].box.meets(small)) stack[top++] = 0;
    while (top > 0) {
      const Node& n = nodes_[stack[--top]];
      if (!keep(to_lattice(n.box))) continue;
      if (n.count > 0) {
        for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
          if (boxes_[i].meets(small) && !visit(order_[i])) return false;
        }
      } else {
        if (nodes_[n.first].box.meets(small)) stack[top++] = n.first;
        if (nodes_[n.first + 1].box.meets(small)) stack[top++] = n.first + 1;
      }
    }
    return true;
  }

 private:
  /// Relative to base_, clamped: 24 bytes, so that a node is 36. Clamping keeps the order, so no meeting is missed.
  struct SmallBox {
    std::array<std::int32_t, 3> min, max;
    [[nodiscard]] bool meets(const SmallBox& b) const {
      return (min[0] <= b.max[0]) & (b.min[0] <= max[0]) & (min[1] <= b.max[1]) & (b.min[1] <= max[1]) &
             (min[2] <= b.max[2]) & (b.min[2] <= max[2]);  // no branches: they would be guesses
    }
    [[nodiscard]] bool contains(const SmallBox& b) const {
      return min[0] <= b.min[0] && min[1] <= b.min[1] && min[2] <= b.min[2] && max[0] >= b.max[0] &&
             max[1] >= b.max[1] && max[2] >= b.max[2];
    }
    void add(const SmallBox& b) {
      for (std::size_t i = 0; i < 3; ++i) {
        min[i] = std::min(min[i], b.min[i]);
        max[i] = std::max(max[i], b.max[i]);
      }
    }
  };
  struct Node {
    SmallBox box;
    std::uint32_t first = 0;  // leaf: first item in order_; inner: left child, the right one follows it
    std::uint32_t count = 0;  // items of a leaf, 0 for inner nodes
    std::uint32_t parent = 0;
  };

  [[nodiscard]] SmallBox to_small(const LatticeBox& b) const {
    const auto clamp = [](std::int64_t v) { return std::int32_t(std::clamp<std::int64_t>(v, INT32_MIN, INT32_MAX)); };
    return {{clamp(b.min.x - base_.x), clamp(b.min.y - base_.y), clamp(b.min.z - base_.z)},
            {clamp(b.max.x - base_.x), clamp(b.max.y - base_.y), clamp(b.max.z - base_.z)}};
  }
  [[nodiscard]] LatticeBox to_lattice(const SmallBox& b) const {
    return {{base_.x + b.min[0], base_.y + b.min[1], base_.z + b.min[2]},
            {base_.x + b.max[0], base_.y + b.max[1], base_.z + b.max[2]}};
  }
  struct Centre {  // of an item's box
    std::array<std::int32_t, 3> at;
    std::uint32_t item;
  };
  void split(std::span<const LatticeBox> boxes, std::span<Centre> centres, std::uint32_t node, std::uint32_t begin);

  LatticeCoord base_{};
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<SmallBox> boxes_;         // of the items, beside order_
  std::vector<std::uint32_t> leaf_of_;  // per item
};

}  // namespace bp
