#include "lib/mesh/box_tree.h"

#include <cmath>

#include "lib/core/vec3.h"
#include "lib/mesh/space_order.h"

namespace bp {

void BoxTree::build(std::span<const LatticeBox> boxes, std::vector<std::uint32_t> items) {
  order_ = std::move(items);
  place_of_.assign(boxes.size(), 0);
  groups_.clear();
  levels_.clear();
  if (order_.empty()) return;
  base_ = boxes[order_[0]].min;
  reach_ = 0;
  sort_in_space(boxes);
  groups_.reserve(order_.size() / (kWidth - 1) + kMostLevels);
  groups_.resize((order_.size() + kWidth - 1) / kWidth);
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    const SmallBox small = to_small(boxes[order_[i]]);
    groups_[i / kWidth].set(i % kWidth, small);
    reach(small);
    place_of_[order_[i]] = i;
  }
  build_levels();
}

/// Sorts the items by the centres of their boxes.
void BoxTree::sort_in_space(std::span<const LatticeBox> boxes) {
  order_ = space_order(
      order_.size(), [this](std::size_t i) { return order_[i]; },
      [&](std::uint32_t item) { return boxes[item].min + boxes[item].max; });
}

/// Builds all levels, from the groups of items up to one root.
void BoxTree::build_levels() {
  levels_.assign(1, 0);
  for (auto count = std::uint32_t(groups_.size()); count > 1; count = (count + kWidth - 1) / kWidth) {
    const std::uint32_t below = levels_.back(), above = below + count;
    levels_.push_back(above);
    groups_.resize(above + (count + kWidth - 1) / kWidth);
    for (std::uint32_t i = 0; i < count; ++i) groups_[above + i / kWidth].set(i % kWidth, groups_[below + i].around());
  }
}

void BoxTree::reach(const SmallBox& b) {
  for (std::size_t i = 0; i < 3; ++i)
    reach_ = std::max({reach_, std::abs(double(b.min[i])), std::abs(double(b.max[i]))});
}

/// The limit covers all rounding of floats. Each of the three terms of n . p passes through at most 6 roundings (n, p,
/// the product, three sums), and the limit through 2: together less than 16 roundings of reach or offset. Clamped boxes
/// may reach further.
BoxGroup::InnerSide BoxTree::inner_side(const Plane& plane) const {
  const double size = length(plane.normal);
  if (!(size > 0) || reach_ >= INT32_MAX - 1) return {{0, 0, 0}, -1};
  const Vec3d n = (1 / size) * plane.normal;
  const LatticeCoord d = plane.point - base_;
  const double offset = dot(n, {double(d.x), double(d.y), double(d.z)});
  const double slack = 0x1p-20 * (reach_ + std::abs(offset));
  return {{float(n[0]), float(n[1]), float(n[2])}, float(offset - slack)};
}

/// Visits groups in the order of walk(): the last child of a group comes first.
void BoxTree::gather(const LatticeBox& box, Nearby& nearby) const {
  constexpr std::size_t kMost = 256;
  nearby.groups_.clear();
  nearby.boxes_.clear();
  nearby.complete_ = false;
  if (levels_.size() < 2) return;
  const BoxQuery query(to_small(box));
  nearby.complete_ = walk([&](const BoxGroup& group) { return group.meeting(query); },
                          [&](std::uint32_t first, std::uint32_t hits) {
                            const BoxGroup& boxes = groups_[levels_[1] + first / kWidth];
                            for (; hits != 0; hits &= std::bit_floor(hits) - 1) {
                              const auto k = std::uint32_t(std::bit_width(hits)) - 1;
                              const auto at = std::uint32_t(nearby.groups_.size() % kWidth);
                              if (at == 0) nearby.boxes_.emplace_back();
                              nearby.boxes_.back().set(at, boxes.box(k));
                              nearby.groups_.push_back(first + k);
                              prefetch(groups_[first + k]);
                            }
                            return nearby.groups_.size() <= kMost;
                          },
                          1);
}

void BoxTree::remove(std::uint32_t item) {
  const std::uint32_t i = place_of_[item];
  groups_[i / kWidth].set(i % kWidth, BoxGroup::kNothing);
}

void BoxTree::update(std::uint32_t item, const LatticeBox& box) {
  const SmallBox small = to_small(box);
  reach(small);
  std::uint32_t i = place_of_[item];
  groups_[i / kWidth].set(i % kWidth, small);
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    i /= kWidth;
    if (!groups_[levels_[level] + i / kWidth].grow(i % kWidth, small)) break;
  }
}

}  // namespace bp
