#include "lib/mesh/face_tree.h"

namespace bp {

void FaceTree::rebuild() {
  std::vector<LatticeBox> boxes(mesh_.face_capacity());
  std::vector<FaceId> live;
  live.reserve(mesh_.face_count());
  for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
    if (!mesh_.alive(f)) continue;
    boxes[f] = box_of_face(f);
    live.push_back(f);
  }
  tree_.build(boxes, std::move(live));
}

}  // namespace bp
