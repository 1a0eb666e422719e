#include "lib/meshing/face_tree.h"

#include <algorithm>

namespace bp {

namespace {

constexpr std::uint32_t kLeafFaces = 4;

}  // namespace

FaceTree::FaceTree(const HalfEdgeMesh& mesh) : mesh_(mesh) {
  rebuild();
}

void FaceTree::maintain() {
  if (mesh_.face_count() * 2 < built_for_) rebuild();
}

void FaceTree::rebuild() {
  order_.clear();
  nodes_.clear();
  centre_.assign(mesh_.face_capacity(), {});
  leaf_of_.assign(mesh_.face_capacity(), kNoId);
  for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
    if (!mesh_.alive(f)) continue;
    order_.push_back(f);
    centre_[f] = mesh_.corner(f, 0) + mesh_.corner(f, 1) + mesh_.corner(f, 2);
  }
  built_for_ = order_.size();
  if (order_.empty()) return;
  base_ = mesh_.corner(order_[0], 0);
  nodes_.reserve(order_.size());
  nodes_.emplace_back();
  split(0, 0, std::uint32_t(order_.size()));
  centre_ = {};
}

void FaceTree::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  if (end - begin <= kLeafFaces) {
    SmallBox box = small_box_of(order_[begin]);
    for (std::uint32_t i = begin; i < end; ++i) {
      box.add(small_box_of(order_[i]));
      leaf_of_[order_[i]] = node;
    }
    nodes_[node].box = box;
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  LatticeBox span{centre_[order_[begin]], centre_[order_[begin]]};
  for (std::uint32_t i = begin; i < end; ++i) span.add(centre_[order_[i]]);
  const LatticeCoord size = span.max - span.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](FaceId a, FaceId b) {
    return centre_[a][axis] != centre_[b][axis] ? centre_[a][axis] < centre_[b][axis] : a < b;
  });
  const auto left = std::uint32_t(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = left;
  nodes_[left].parent = nodes_[left + 1].parent = node;
  split(left, begin, middle);
  split(left + 1, middle, end);
  nodes_[node].box = nodes_[left].box;
  nodes_[node].box.add(nodes_[left + 1].box);
}

void FaceTree::update(FaceId f) {
  const SmallBox box = small_box_of(f);
  std::uint32_t n = leaf_of_[f];
  while (!nodes_[n].box.contains(box)) {
    nodes_[n].box.add(box);
    if (n == 0) break;
    n = nodes_[n].parent;
  }
}

}  // namespace bp
