#include "lib/meshing/face_tree.h"

#include <algorithm>

namespace bp {

namespace {

constexpr std::uint32_t kLeafFaces = 4;

LatticeBox box_of_face(const HalfEdgeMesh& mesh, FaceId f) {
  return box_of(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2));
}

void add(LatticeBox& to, const LatticeBox& b) {
  to.add(b.min);
  to.add(b.max);
}

}  // namespace

LatticeBox box_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  LatticeBox box{a, a};
  box.add(b);
  box.add(c);
  return box;
}

FaceTree::FaceTree(const HalfEdgeMesh& mesh) : mesh_(mesh) {
  build();
}

void FaceTree::maintain() {
  if (mesh_.face_count() * 2 < built_for_) build();
}

void FaceTree::build() {
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
  nodes_.reserve(order_.size());
  nodes_.emplace_back();
  split(0, 0, std::uint32_t(order_.size()));
  centre_ = {};
}

void FaceTree::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  if (end - begin <= kLeafFaces) {
    LatticeBox box = box_of_face(mesh_, order_[begin]);
    for (std::uint32_t i = begin; i < end; ++i) {
      add(box, box_of_face(mesh_, order_[i]));
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
  add(nodes_[node].box, nodes_[left + 1].box);
}

void FaceTree::update(FaceId f) {
  const LatticeBox box = box_of_face(mesh_, f);
  std::uint32_t n = leaf_of_[f];
  while (!nodes_[n].box.contains(box)) {
    add(nodes_[n].box, box);
    if (n == 0) break;
    n = nodes_[n].parent;
  }
}

}  // namespace bp
