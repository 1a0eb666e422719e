#include "lib/simplify/waves.h"

#include <algorithm>

namespace bp {

// The vertices of the edge are tested first: for an edge at a vertex of thousands of faces, hardly anything else is
// read.

bool WaveClaims::star_is_free(VertexId v) {
  if (!is_free(v)) return false;
  vertices_.clear();
  gather(v);
  return are_free();
}

bool WaveClaims::stars_are_free(HalfEdgeId h) {
  if (!is_free(mesh_.from(h)) || !is_free(mesh_.to(h))) return false;
  vertices_.clear();
  gather(mesh_.from(h));
  gather(mesh_.to(h));
  return are_free();
}

bool WaveClaims::faces_are_free(HalfEdgeId h) {
  vertices_ = {mesh_.from(h), mesh_.to(h), mesh_.opposite(h), mesh_.opposite(mesh_.twin(h))};
  return are_free();
}

void WaveClaims::gather(VertexId v) {
  vertices_.push_back(v);
  mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { vertices_.push_back(mesh_.to(h)); });
}

bool WaveClaims::are_free() const {
  return std::all_of(vertices_.begin(), vertices_.end(), [&](VertexId v) { return is_free(v); });
}

void EditBoxes::add(const LatticeBox& face) {
  if (faces.empty()) all = face;
  all.add(face.min);
  all.add(face.max);
  faces.push_back(face);
}

bool EditBoxes::meet(const EditBoxes& others) const {
  if (!all.meets(others.all)) return false;
  return std::any_of(faces.begin(), faces.end(), [&](const LatticeBox& a) {
    return a.meets(others.all) &&
           std::any_of(others.faces.begin(), others.faces.end(), [&](const LatticeBox& b) { return a.meets(b); });
  });
}

bool WaveBoxes::add(const EditBoxes& boxes) {
  const auto end = boxes_.begin() + std::ptrdiff_t(count_);
  if (std::any_of(boxes_.begin(), end, [&](const EditBoxes& b) { return b.meet(boxes); })) return false;
  if (count_ == boxes_.size()) boxes_.emplace_back();
  boxes_[count_++] = boxes;
  return true;
}

}  // namespace bp
