#include "lib/meshing/box_tree.h"

namespace bp {

namespace {

constexpr std::uint32_t kLeafItems = 4;

}  // namespace

void BoxTree::build(std::span<const LatticeBox> boxes, std::vector<std::uint32_t> items) {
  order_ = std::move(items);
  nodes_.clear();
  boxes_.resize(order_.size());
  leaf_of_.assign(boxes.size(), 0);
  if (order_.empty()) return;
  base_ = boxes[order_[0]].min;
  std::vector<Centre> centres(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const SmallBox box = to_small(boxes[order_[i]]);
    for (std::size_t k = 0; k < 3; ++k) centres[i].at[k] = box.min[k] / 2 + box.max[k] / 2;
    centres[i].item = order_[i];
  }
  nodes_.reserve(order_.size());
  nodes_.emplace_back();
  split(boxes, centres, 0, 0);
}

/// `centres`: of the items below the node, the first of which is number `begin` in the order.
void BoxTree::split(std::span<const LatticeBox> boxes, std::span<Centre> centres, std::uint32_t node,
                    std::uint32_t begin) {
  const auto n = std::uint32_t(centres.size());
  if (n <= kLeafItems) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t item = centres[i].item;
      order_[begin + i] = item;
      boxes_[begin + i] = to_small(boxes[item]);
      leaf_of_[item] = node;
      if (i == 0) nodes_[node].box = boxes_[begin];
      nodes_[node].box.add(boxes_[begin + i]);
    }
    nodes_[node].first = begin;
    nodes_[node].count = n;
    return;
  }
  std::array<std::int32_t, 3> low = centres[0].at, high = low;
  for (const Centre& c : centres) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c.at[k]);
      high[k] = std::max(high[k], c.at[k]);
    }
  }
  const auto size = [&](std::size_t k) { return std::int64_t(high[k]) - low[k]; };
  const std::size_t axis = size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
  std::nth_element(centres.begin(), centres.begin() + n / 2, centres.end(), [&](const Centre& a, const Centre& b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.item < b.item;
  });
  const auto left = std::uint32_t(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = left;
  nodes_[left].parent = nodes_[left + 1].parent = node;
  split(boxes, centres.first(n / 2), left, begin);
  split(boxes, centres.subspan(n / 2), left + 1, begin + n / 2);
  nodes_[node].box = nodes_[left].box;
  nodes_[node].box.add(nodes_[left + 1].box);
}

void BoxTree::update(std::uint32_t item, const LatticeBox& box) {
  const SmallBox small = to_small(box);
  std::uint32_t n = leaf_of_[item];
  std::uint32_t slot = nodes_[n].first;
  while (order_[slot] != item) ++slot;
  boxes_[slot] = small;
  while (!nodes_[n].box.contains(small)) {
    nodes_[n].box.add(small);
    if (n == 0) break;
    n = nodes_[n].parent;
  }
}

}  // namespace bp
