#include "lib/meshing/box_tree.h"

namespace bp {

namespace {

constexpr std::uint32_t kLeafItems = 4;

}  // namespace

void BoxTree::build(std::span<const LatticeBox> boxes, std::vector<std::uint32_t> items) {
  order_ = std::move(items);
  nodes_.clear();
  leaf_of_.assign(boxes.size(), 0);
  if (order_.empty()) return;
  base_ = boxes[order_[0]].min;
  nodes_.reserve(order_.size());
  nodes_.emplace_back();
  split(boxes, 0, 0, std::uint32_t(order_.size()));
}

void BoxTree::split(std::span<const LatticeBox> boxes, std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  if (end - begin <= kLeafItems) {
    SmallBox box = to_small(boxes[order_[begin]]);
    for (std::uint32_t i = begin; i < end; ++i) {
      box.add(to_small(boxes[order_[i]]));
      leaf_of_[order_[i]] = node;
    }
    nodes_[node].box = box;
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const auto centre = [&](std::uint32_t item) { return boxes[item].min + boxes[item].max; };  // twice the centre
  LatticeBox span{centre(order_[begin]), centre(order_[begin])};
  for (std::uint32_t i = begin; i < end; ++i) span.add(centre(order_[i]));
  const LatticeCoord size = span.max - span.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const std::int64_t ca = centre(a)[axis], cb = centre(b)[axis];
                     return ca != cb ? ca < cb : a < b;
                   });
  const auto left = std::uint32_t(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = left;
  nodes_[left].parent = nodes_[left + 1].parent = node;
  split(boxes, left, begin, middle);
  split(boxes, left + 1, middle, end);
  nodes_[node].box = nodes_[left].box;
  nodes_[node].box.add(nodes_[left + 1].box);
}

void BoxTree::grow(std::uint32_t item, const LatticeBox& box) {
  const SmallBox small = to_small(box);
  std::uint32_t n = leaf_of_[item];
  while (!nodes_[n].box.contains(small)) {
    nodes_[n].box.add(small);
    if (n == 0) break;
    n = nodes_[n].parent;
  }
}

}  // namespace bp
