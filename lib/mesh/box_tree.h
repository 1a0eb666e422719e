#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/mesh/box_group.h"

/// A bounding volume hierarchy over boxes of lattice points: the broad phase of all exact tests.
namespace bp {

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
    return query_places(box, [&](std::uint32_t place) { return visit(order_[place]); });
  }
  /// The same, by their places in order().
  template <class Visit>
  bool query_places(const LatticeBox& box, Visit&& visit) const {
    const BoxQuery query(to_small(box));
    return walk([&](const BoxGroup& group) { return group.meeting(query); },
                [&](std::uint32_t first, std::uint32_t hits) {
                  for (; hits != 0; hits &= hits - 1) {
                    if (!visit(first + std::uint32_t(std::countr_zero(hits)))) return false;
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
    const BoxQuery query(to_small(box));
    const BoxGroup::InnerSide inner = inner_side(plane);
    return walk([&](const BoxGroup& group) { return group.meeting(query); },
                [&](std::uint32_t first, std::uint32_t hits) {
                  hits &= ~groups_[first / kWidth].inside(inner);
                  return hits == 0 || visit(first, hits);
                });
  }

  /// Groups of items that meet a box, with their boxes: for several questions about boxes within it.
  class Nearby {
   public:
    [[nodiscard]] bool complete() const { return complete_; }

   private:
    friend BoxTree;
    std::vector<std::uint32_t> groups_;  // in the order in which a query visits them
    std::vector<BoxGroup> boxes_;        // around them
    bool complete_ = false;
  };
  /// Not complete, after some work in vain, if the box meets hundreds of groups.
  void gather(const LatticeBox& box, Nearby& nearby) const;
  /// The same as without `nearby`, which is complete, of a box around this one.
  template <class Visit>
  bool query_groups(const Nearby& nearby, const LatticeBox& box, const Plane& plane, Visit&& visit) const {
    const BoxQuery query(to_small(box));
    const BoxGroup::InnerSide inner = inner_side(plane);
    for (std::size_t i = 0; i < nearby.boxes_.size(); ++i) {
      for (std::uint32_t near = nearby.boxes_[i].meeting(query); near != 0; near &= near - 1) {
        const std::uint32_t group = nearby.groups_[i * kWidth + std::uint32_t(std::countr_zero(near))];
        std::uint32_t hits = groups_[group].meeting(query);
        if (hits != 0) hits &= ~groups_[group].inside(inner);
        if (hits != 0 && !visit(group * kWidth, hits)) return false;
      }
    }
    return true;
  }
  /// Items, those near in space near each other; changes with build() only.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  [[nodiscard]] const LatticeCoord& base() const { return base_; }  ///< a point near the items

 private:
  static constexpr std::uint32_t kWidth = BoxGroup::kWidth;
  static constexpr std::size_t kMostLevels = 11;  // 8^11 > 2^32

  struct Place {
    std::uint32_t level, group;
  };
  static void prefetch(const BoxGroup& group) {
    constexpr std::size_t kCacheLine = 64;
    for (std::size_t at = 0; at < sizeof(BoxGroup); at += kCacheLine)
      __builtin_prefetch(reinterpret_cast<const char*>(&group) + at);
  }

  /// visit(first, hits) for the groups of `lowest` level that are reached through the children hits(group).
  template <class Hits, class Visit>
  bool walk(Hits&& hits_of, Visit&& visit, std::uint32_t lowest = 0) const {
    if (levels_.empty()) return true;
    Place stack[kMostLevels * kWidth];
    int top = 0;
    stack[top++] = {std::uint32_t(levels_.size() - 1), 0};
    while (top > 0) {
      const Place place = stack[--top];
      std::uint32_t hits = hits_of(groups_[levels_[place.level] + place.group]);
      const std::uint32_t first = place.group * kWidth;
      if (place.level == lowest) {
        if (hits != 0 && !visit(first, hits)) return false;
        continue;
      }
      for (; hits != 0; hits &= hits - 1) {
        const Place below{place.level - 1, first + std::uint32_t(std::countr_zero(hits))};
        prefetch(groups_[levels_[below.level] + below.group]);
        stack[top++] = below;
      }
    }
    return true;
  }

  [[nodiscard]] SmallBox to_small(const LatticeBox& b) const { return relative_to(base_, b); }
  [[nodiscard]] BoxGroup::InnerSide inner_side(const Plane& plane) const;
  void reach(const SmallBox& b);
  void sort_in_space(std::span<const LatticeBox> boxes);
  void build_levels();

  LatticeCoord base_{};
  double reach_ = 0;                     // largest coordinate of a box since build(), relative to base_
  std::vector<BoxGroup> groups_;         // all groups of items, then those of the groups, ... the root last
  std::vector<std::uint32_t> levels_;    // where each level begins in groups_
  std::vector<std::uint32_t> order_;     // items; group g holds those from 8 g on
  std::vector<std::uint32_t> place_of_;  // per item: in order_
};

}  // namespace bp
