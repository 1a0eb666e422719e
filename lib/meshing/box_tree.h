#pragma once
#include <algorithm>
#include <array>
#include <bit>
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

/// Items lie in the order of a space-filling curve; eight in a row are a group, the boxes of eight groups a group of
/// the next level, and so on. The boxes of a group are compared at once, and what is where follows from numbers: no
/// pointers, about 32 bytes an item.
class BoxTree {
 public:
  /// Item i has the box boxes[i]; only those listed in `items` are in the tree. Linear.
  void build(std::span<const LatticeBox> boxes, std::vector<std::uint32_t> items);
  /// A changed item: its own box is exact again, those above it only grow, build() makes them tight. O(depth).
  void update(std::uint32_t item, const LatticeBox& box);
  /// The item is not found any more, nor may it be changed, until the next build(). O(1).
  void remove(std::uint32_t item);
  [[nodiscard]] std::size_t size() const { return order_.size(); }  ///< when built

  /// visit(item) for every item whose box meets `box`; stops when visit returns false, and returns false then.
  template <class Visit>
  bool query(const LatticeBox& box, Visit&& visit) const {
    return query(
        box, [](const LatticeBox&) { return true; }, visit);
  }
  /// The same, without the items and subtrees whose box keep(box) refuses. Boxes beyond 2^31 lattice units of the first
  /// item are clamped, so `keep` must be for boxes within.
  template <class Keep, class Visit>
  bool query(const LatticeBox& box, Keep&& keep, Visit&& visit) const {
    if (levels_.empty()) return true;
    const SmallBox small = to_small(box);
    Place stack[kMostLevels * kWidth];
    int top = 0;
    stack[top++] = {std::uint32_t(levels_.size() - 1), 0};
    while (top > 0) {
      const Place place = stack[--top];
      const Group& group = groups_[levels_[place.level] + place.group];
      for (std::uint32_t hits = group.meeting(small); hits != 0; hits &= hits - 1) {
        const auto k = std::uint32_t(std::countr_zero(hits));
        if (!keep(to_lattice(group.box(k)))) continue;
        const std::uint32_t child = place.group * kWidth + k;
        if (place.level > 0) {
          stack[top++] = {place.level - 1, child};
        } else if (!visit(order_[child])) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  static constexpr std::uint32_t kWidth = 8;
  static constexpr std::size_t kMostLevels = 11;  // 8^11 > 2^32

  /// Relative to base_, clamped. Clamping keeps the order, so no meeting is missed.
  struct SmallBox {
    std::array<std::int32_t, 3> min, max;
  };
  static constexpr SmallBox kNothing{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  /// The boxes of eight children, side by side in vectors of GCC and Clang.
  struct Group {
    typedef std::int32_t Four __attribute__((vector_size(16)));
    Four min[3][2], max[3][2];

    Group() {  // kNothing meets nothing: it is beyond all that to_small() returns
      for (std::uint32_t k = 0; k < kWidth; ++k) set(k, kNothing);
    }
    /// Bit k: child k meets `b`. No branches: they would be guesses.
    [[nodiscard]] std::uint32_t meeting(const SmallBox& b) const {
      const auto apart = [&](std::size_t half) {
        return (min[0][half] > b.max[0]) | (max[0][half] < b.min[0]) | (min[1][half] > b.max[1]) |
               (max[1][half] < b.min[1]) | (min[2][half] > b.max[2]) | (max[2][half] < b.min[2]);
      };
      const Four hits = (~apart(0) & Four{1, 2, 4, 8}) | (~apart(1) & Four{16, 32, 64, 128});
      const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(hits);
      const std::uint64_t both = halves[0] | halves[1];
      return std::uint32_t(both | both >> 32);
    }
    [[nodiscard]] SmallBox box(std::uint32_t k) const {
      const std::uint32_t half = k / 4, lane = k % 4;
      return {{min[0][half][lane], min[1][half][lane], min[2][half][lane]},
              {max[0][half][lane], max[1][half][lane], max[2][half][lane]}};
    }
    void set(std::uint32_t k, const SmallBox& b);
    bool grow(std::uint32_t k, const SmallBox& b);  ///< false if child k holds `b` already
    [[nodiscard]] SmallBox around() const;
  };
  struct Place {
    std::uint32_t level, group;
  };

  [[nodiscard]] SmallBox to_small(const LatticeBox& b) const {
    const auto clamp = [](std::int64_t v) {
      return std::int32_t(std::clamp<std::int64_t>(v, INT32_MIN + 1, INT32_MAX - 1));
    };
    return {{clamp(b.min.x - base_.x), clamp(b.min.y - base_.y), clamp(b.min.z - base_.z)},
            {clamp(b.max.x - base_.x), clamp(b.max.y - base_.y), clamp(b.max.z - base_.z)}};
  }
  [[nodiscard]] LatticeBox to_lattice(const SmallBox& b) const {
    return {{base_.x + b.min[0], base_.y + b.min[1], base_.z + b.min[2]},
            {base_.x + b.max[0], base_.y + b.max[1], base_.z + b.max[2]}};
  }
  void sort_in_space(std::span<const LatticeBox> boxes);
  void build_levels();

  LatticeCoord base_{};
  std::vector<Group> groups_;            // all groups of items, then those of the groups, ... the root last
  std::vector<std::uint32_t> levels_;    // where each level begins in groups_
  std::vector<std::uint32_t> order_;     // items; group g holds those from 8 g on
  std::vector<std::uint32_t> place_of_;  // per item: in order_
};

}  // namespace bp
