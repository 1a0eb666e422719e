#pragma once
#include <vector>

#include "lib/core/box.h"
#include "lib/meshing/half_edge_mesh.h"

/// Broad phase of the guard: a bounding volume hierarchy over the live faces that follows the mesh as it changes.
/// Changed faces only ever grow their node's box; when half of the faces are gone the tree is rebuilt, so its cost
/// stays that of a fresh one.
namespace bp {

/// Closed box of lattice points.
struct LatticeBox {
  LatticeCoord min{}, max{};
  [[nodiscard]] bool meets(const LatticeBox& b) const {
    return min.x <= b.max.x && b.min.x <= max.x && min.y <= b.max.y && b.min.y <= max.y && min.z <= b.max.z &&
           b.min.z <= max.z;
  }
  void add(const LatticeCoord& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  [[nodiscard]] bool contains(const LatticeBox& b) const {
    return min.x <= b.min.x && min.y <= b.min.y && min.z <= b.min.z && max.x >= b.max.x && max.y >= b.max.y &&
           max.z >= b.max.z;
  }
};
[[nodiscard]] LatticeBox box_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c);

class FaceTree {
 public:
  explicit FaceTree(const HalfEdgeMesh& mesh);

  /// Call after the corners of a live face moved.
  void update(FaceId f);
  /// Call now and then; rebuilds when half of the faces are dead.
  void maintain();

  /// visit(FaceId) for every live face in a leaf that meets `box` (a superset of the faces whose own box does);
  /// stops when visit returns false, and returns false then.
  template <class Visit>
  bool query(const LatticeBox& box, Visit&& visit) const {
    if (nodes_.empty()) return true;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& n = nodes_[stack[--top]];
      if (!n.box.meets(box)) continue;
      if (n.count > 0) {
        for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
          if (mesh_.alive(order_[i]) && !visit(order_[i])) return false;
        }
      } else {
        stack[top++] = n.first;
        stack[top++] = n.first + 1;
      }
    }
    return true;
  }

 private:
  struct Node {
    LatticeBox box;
    std::uint32_t first = 0;  // leaf: first face in order_; inner: left child, the right one follows it
    std::uint32_t count = 0;  // faces of a leaf, 0 for inner nodes
    std::uint32_t parent = 0;
  };
  void build();
  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  const HalfEdgeMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<FaceId> order_;
  std::vector<std::uint32_t> leaf_of_;  // per face
  std::vector<LatticeCoord> centre_;    // per face, sum of its corners; only while building
  std::size_t built_for_ = 0;
};

}  // namespace bp
