#pragma once
#include "lib/mesh/box_tree.h"
#include "lib/mesh/half_edge_mesh.h"

/// The tree of a mesh's live faces. It follows the mesh as it changes: changed faces grow the boxes of their nodes.
/// When half of the faces are gone, the tree is rebuilt, so its cost stays that of a fresh one.
namespace bp {

class FaceTree {
 public:
  explicit FaceTree(const HalfEdgeMesh& mesh) : mesh_(mesh) { rebuild(); }

  void update(FaceId f) { tree_.update(f, box_of_face(f)); }  ///< call after the corners of a live face moved
  void remove(FaceId f) { tree_.remove(f); }                  ///< call for every face that dies
  void rebuild();                                             ///< makes all boxes tight
  void maintain() {                                           ///< rebuilds the tree if half of the faces are dead
    if (mesh_.face_count() * 2 < tree_.size()) rebuild();
  }
  /// Queries faces, as BoxTree::query() does.
  template <class Visit>
  bool query(const LatticeBox& box, Visit&& visit) const {
    return tree_.query(box, visit);
  }

 private:
  [[nodiscard]] LatticeBox box_of_face(FaceId f) const {
    return box_of(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2));
  }
  const HalfEdgeMesh& mesh_;
  BoxTree tree_;
};

}  // namespace bp
