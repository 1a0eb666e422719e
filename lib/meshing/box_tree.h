#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/coords.h"
#include "lib/meshing/lanes.h"

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

/// Around points, one or more.
[[nodiscard]] inline LatticeBox box_of(std::span<const LatticeCoord> points) {
  LatticeBox box{points.front(), points.front()};
  for (const LatticeCoord& p : points) box.add(p);
  return box;
}
[[nodiscard]] inline LatticeBox intersect(const LatticeBox& a, const LatticeBox& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
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
    const SmallBox small = to_small(box);
    return walk([&](const Group& group) { return group.meeting(small); },
                [&](std::uint32_t first, std::uint32_t hits) {
                  for (; hits != 0; hits &= hits - 1) {
                    if (!visit(order_[first + std::uint32_t(std::countr_zero(hits))])) return false;
                  }
                  return true;
                });
  }

  /// Its inner side is the open half-space that the normal points away from. `normal`: of any length, each component
  /// to a rounding.
  struct Plane {
    LatticeCoord point;
    Vec3d normal;
  };
  /// The same, without some that lie wholly on the inner side of `plane`, and eight at a time: visit(first, hits) means
  /// the items order()[first + k] for the bits k of `hits`.
  template <class Visit>
  bool query_groups(const LatticeBox& box, const Plane& plane, Visit&& visit) const {
    const SmallBox small = to_small(box);
    const InnerSide inner = inner_side(plane);
    return walk(
        [&](const Group& group) {
          const std::uint32_t hits = group.meeting(small);
          return hits == 0 ? 0 : hits & ~group.inside(inner);
        },
        visit);
  }
  /// Items, those near in space near each other; changes with build() only.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  [[nodiscard]] const LatticeCoord& base() const { return base_; }  ///< a point near the items

 private:
  static constexpr std::uint32_t kWidth = 8;
  static constexpr std::size_t kMostLevels = 11;  // 8^11 > 2^32

  /// Relative to base_, clamped. Clamping keeps the order, so no meeting is missed.
  struct SmallBox {
    std::array<std::int32_t, 3> min, max;
  };
  static constexpr SmallBox kNothing{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  /// n . p < limit only for points p, relative to base_, strictly on the inner side.
  struct InnerSide {
    std::array<float, 3> n;
    float limit;
  };
  /// The boxes of eight children, side by side.
  struct Group {
    FourInts min[3][2], max[3][2];

    Group() {  // kNothing meets nothing: it is beyond all that to_small() returns
      for (std::uint32_t k = 0; k < kWidth; ++k) set(k, kNothing);
    }
    /// Bit k: child k meets `b`.
    [[nodiscard]] std::uint32_t meeting(const SmallBox& b) const {
      const auto meets = [&](std::size_t half) {
        return (min[0][half] <= b.max[0]) & (max[0][half] >= b.min[0]) & (min[1][half] <= b.max[1]) &
               (max[1][half] >= b.min[1]) & (min[2][half] <= b.max[2]) & (max[2][half] >= b.min[2]);
      };
      return bits_of(meets(0), meets(1));
    }
    /// Bit k: child k, if it is there, lies on the inner side.
    [[nodiscard]] std::uint32_t inside(const InnerSide& side) const {
      const auto below = [&](std::size_t half) {
        FourFloats far{};
        for (std::size_t i = 0; i < 3; ++i)
          far += side.n[i] * __builtin_convertvector(side.n[i] > 0 ? max[i][half] : min[i][half], FourFloats);
        return far < side.limit;
      };
      return bits_of(below(0), below(1));
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

  /// visit(first, hits) for the groups of items that are reached through the children hits(group).
  template <class Hits, class Visit>
  bool walk(Hits&& hits_of, Visit&& visit) const {
    if (levels_.empty()) return true;
    Place stack[kMostLevels * kWidth];
    int top = 0;
    stack[top++] = {std::uint32_t(levels_.size() - 1), 0};
    while (top > 0) {
      const Place place = stack[--top];
      std::uint32_t hits = hits_of(groups_[levels_[place.level] + place.group]);
      const std::uint32_t first = place.group * kWidth;
      if (place.level == 0) {
        if (hits != 0 && !visit(first, hits)) return false;
        continue;
      }
      for (; hits != 0; hits &= hits - 1)
        stack[top++] = {place.level - 1, first + std::uint32_t(std::countr_zero(hits))};
    }
    return true;
  }

  [[nodiscard]] SmallBox to_small(const LatticeBox& b) const {
    const auto clamp = [](std::int64_t v) {
      return std::int32_t(std::clamp<std::int64_t>(v, INT32_MIN + 1, INT32_MAX - 1));
    };
    return {{clamp(b.min.x - base_.x), clamp(b.min.y - base_.y), clamp(b.min.z - base_.z)},
            {clamp(b.max.x - base_.x), clamp(b.max.y - base_.y), clamp(b.max.z - base_.z)}};
  }
  [[nodiscard]] InnerSide inner_side(const Plane& plane) const;
  void reach(const SmallBox& b);
  void sort_in_space(std::span<const LatticeBox> boxes);
  void build_levels();

  LatticeCoord base_{};
  double reach_ = 0;                     // largest coordinate of a box since build(), relative to base_
  std::vector<Group> groups_;            // all groups of items, then those of the groups, ... the root last
  std::vector<std::uint32_t> levels_;    // where each level begins in groups_
  std::vector<std::uint32_t> order_;     // items; group g holds those from 8 g on
  std::vector<std::uint32_t> place_of_;  // per item: in order_
};

}  // namespace bp
