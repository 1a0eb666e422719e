#include "lib/meshing/guard.h"

#include "lib/core/triangle_intersection.h"

namespace bp {

namespace {

/// Meeting beyond what the ids say they share.
bool meet(const NewFace& a, const NewFace& b) {
  int shared = 0, ia[3] = {}, ib[3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (a.ids[std::size_t(i)] == b.ids[std::size_t(j)] && shared < 3) ia[shared] = i, ib[shared] = j, ++shared;
    }
  }
  const LatticeCoord *ta = a.corners.data(), *tb = b.corners.data();
  switch (shared) {
    case 0:
      return triangles_intersect(ta, tb);
    case 1:
      return triangles_meet_beyond_shared_vertex(ta, ia[0], tb, ib[0]);
    case 2:
      return triangles_meet_beyond_shared_edge(ta[ia[0]], ta[ia[1]], ta[3 - ia[0] - ia[1]], tb[3 - ib[0] - ib[1]]);
    default:
      return true;
  }
}

/// Sufficient and cheap: seen along some axis all faces turn the same way around the apex, and once. Then the fan is a
/// graph over its shadow. Holds for nearly every star; the others are compared pair by pair.
bool is_graph_along_axis(std::span<const NewFace> star) {
  bool positive[3] = {true, true, true}, negative[3] = {true, true, true};
  for (const NewFace& f : star) {
    const LatticeCoord n = normal_of(f.corners[0], f.corners[1], f.corners[2]);
    for (int axis = 0; axis < 3; ++axis) {
      positive[axis] &= n[axis] > 0;
      negative[axis] &= n[axis] < 0;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!positive[axis] && !negative[axis]) continue;
    const int w = (axis + 2) % 3;
    int rounds = 0;  // the fan crosses the half-plane w = apex in the same sense once per turn
    for (const NewFace& f : star) {
      const bool below = f.corners[1][w] < f.corners[0][w], beyond = f.corners[2][w] < f.corners[0][w];
      rounds += below && !beyond;
    }
    if (rounds == 1) return true;
  }
  return false;
}

bool disjoint_pairs(std::span<const NewFace> faces) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (meet(faces[i], faces[j])) return false;
    }
  }
  return true;
}

}  // namespace

bool Guard::star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced) {
  return (is_graph_along_axis(star) || disjoint_pairs(star)) && clear_of_mesh(star, replaced);
}

bool Guard::faces_are_free(std::span<const NewFace> faces, std::span<const FaceId> replaced) {
  return disjoint_pairs(faces) && clear_of_mesh(faces, replaced);
}

bool Guard::clear_of_mesh(std::span<const NewFace> faces, std::span<const FaceId> replaced) {
  ++stamp_;
  for (const FaceId f : replaced) removed_[f] = stamp_;
  boxes_.clear();
  LatticeBox all{faces[0].corners[0], faces[0].corners[0]};
  for (const NewFace& f : faces) {
    boxes_.push_back(box_of(f.corners[0], f.corners[1], f.corners[2]));
    all.add(boxes_.back().min);
    all.add(boxes_.back().max);
  }
  return tree_.query(all, [&](FaceId other) { return removed_[other] == stamp_ || clear_of_face(faces, all, other); });
}

bool Guard::clear_of_face(std::span<const NewFace> faces, const LatticeBox& all, FaceId other) const {
  NewFace o;
  for (std::size_t k = 0; k < 3; ++k) {
    o.ids[k] = mesh_.from(3 * other + HalfEdgeId(k));
    o.corners[k] = mesh_.position(o.ids[k]);
  }
  const LatticeBox box = box_of(o.corners[0], o.corners[1], o.corners[2]);
  if (!box.meets(all)) return true;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (boxes_[i].meets(box) && meet(faces[i], o)) return false;
  }
  return true;
}

}  // namespace bp
