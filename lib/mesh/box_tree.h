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

/// Items lie in the order of a space-filling curve. Eight in a row are a group, the boxes of eight groups are a group
/// of the next level, and so on. The boxes of a group are compared at once. Places follow from numbers, so there are no
/// pointers: about 32 bytes an item.
class BoxTree {
 public:
  /// Builds the tree. Item i has the box boxes[i]; only the items of `items` are in the tree. Linear.
  void build(std::span<const LatticeBox> boxes, std::vector<std::uint32_t> items);
  /// Gives an item a new box. The item's own box is exact, the boxes above it only grow; build() makes them tight.
  /// O(depth).
  void update(std::uint32_t item, const LatticeBox& box);
  /// Takes an item out. update() puts it back until the next build(). O(1).
  void remove(std::uint32_t item);
  [[nodiscard]] std::size_t size() const { return order_.size(); }  ///< number of items when the tree was built

  /// Calls visit(item) for every item whose box meets `box`. Stops when visit returns false, and returns false then.
  template <class Visit>
  bool query(const LatticeBox& box, Visit&& visit) const {
    return query_places(box, [&](std::uint32_t place) { return visit(order_[place]); });
  }
  /// Does the same with the items' places in order().
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

  /// A plane whose inner side is the open half-space that the normal points away from. `normal` has any length, and
  /// each component is right to a rounding.
  struct Plane {
    LatticeCoord point;
    Vec3d normal;
  };
  /// Does the same, but may leave out items that lie wholly on the inner side of `plane`. It visits eight at a time:
  /// visit(first, hits) means the items order()[first + k] for the bits k of `hits`.
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

  /// The groups of items that meet a box, with their boxes. It serves several queries of boxes within that box.
  class Nearby {
   public:
    [[nodiscard]] bool complete() const { return complete_; }

   private:
    friend BoxTree;
    std::vector<std::uint32_t> groups_;  // in the order in which a query visits them
    std::vector<BoxGroup> boxes_;        // the boxes of the groups
    bool complete_ = false;
  };
  /// Fills `nearby`. If the box meets hundreds of groups, it gives up and leaves `nearby` incomplete.
  void gather(const LatticeBox& box, Nearby& nearby) const;
  /// Does the same as the query without `nearby`, which must be complete and of a box around this one.
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
  /// Returns the items, neighbours in space near each other. Only build() changes the order.
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

  /// Calls visit(first, hits) for the groups of the lowest level that are reached through the children hits(group).
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
  std::vector<BoxGroup> groups_;         // the groups of items, then the groups of groups, ... and the root last
  std::vector<std::uint32_t> levels_;    // where each level begins in groups_
  std::vector<std::uint32_t> order_;     // items; group g holds those from place 8 g on
  std::vector<std::uint32_t> place_of_;  // place of each item in order_
};

}  // namespace bp
