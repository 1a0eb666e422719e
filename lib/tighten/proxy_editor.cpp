#include "lib/tighten/proxy_editor.h"

#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"

namespace bp {

ProxyEditor::ProxyEditor(HalfEdgeMesh& mesh, const Enclosed& enclosed, const ShapeLimits& limits)
    : mesh_(mesh),
      edge_limit_(limits.edge_limit),
      inwards_(faces_inwards(mesh)),
      first_reach_(limits.reach),
      reach_(limits.reach),
      tree_(mesh),
      sense_(mesh),
      contacts_(enclosed, mesh, tree_),
      proxy_{mesh_, tree_, enclosed, contacts_, edge_limit_, limits.limits, intersect(mesh.room(), limits.room),
             reach_},
      check_(proxy_) {
  if (limits.limits != nullptr) limits.limits->begin(mesh.volume6());
}

bool ProxyEditor::loosen() {
  if (reach_ == 0 || check_.counts.beyond_reach == beyond_reach_before_) return false;
  beyond_reach_before_ = check_.counts.beyond_reach;
  reach_ = loosened(reach_, first_reach_);
  return true;
}

bool ProxyEditor::move(VertexId v, const LatticeCoord& to) {
  const bool allowed = check_.allows_move(v, to);
  if (allowed) make_move(v, to);
  return allowed;
}

void ProxyEditor::make_move(VertexId v, const LatticeCoord& to) {
  replaced_.clear();
  mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { replaced_.push_back(HalfEdgeMesh::face(h)); });
  sense_.add(replaced_.front(), fan_gain6(mesh_, replaced_, to));
  mesh_.move(v, to);
  update_around(v);
}

bool ProxyEditor::collapse(HalfEdgeId h, const LatticeCoord& to) {
  if (!check_.allows_collapse(h, to)) return false;
  replaced_ = check_.replaced();
  sense_.add(replaced_.front(), fan_gain6(mesh_, replaced_, to));
  const VertexId u = mesh_.from(h);
  for (const HalfEdgeId g : {h, mesh_.twin(h)}) tree_.remove(HalfEdgeMesh::face(g));
  mesh_.collapse(h, to);
  update_around(u);
  tree_.maintain();
  return true;
}

bool ProxyEditor::flip(HalfEdgeId h) {
  const bool allowed = check_.allows_flip(h);
  if (allowed) make_flip(h);
  return allowed;
}

/// The new faces are a fan around one end of the new edge, if flat faces count.
void ProxyEditor::make_flip(HalfEdgeId h) {
  const HalfEdgeId t = mesh_.twin(h);
  replaced_ = {HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  sense_.add(replaced_.front(), fan_gain6(mesh_, replaced_, mesh_.position(mesh_.opposite(t))));
  mesh_.flip(h);
  for (const FaceId f : replaced_) tree_.update(f);
  contacts_.hand_over(replaced_, replaced_);
}

bool ProxyEditor::is_convex(HalfEdgeId h) const {
  return orient3d(mesh_.position(mesh_.from(h)), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h)),
                  mesh_.position(mesh_.opposite(mesh_.twin(h)))) < 0;
}

void ProxyEditor::learn(VertexId v, std::span<const Vec3d> points) {
  around_.clear();
  mesh_.for_each_outgoing(v, [&](HalfEdgeId g) { around_.push_back(HalfEdgeMesh::face(g)); });
  const Vec3d shift = to_double(mesh_.position(v) - contacts_.origin());
  for (const Vec3d& p : points) contacts_.add(p + shift, around_);
}

void ProxyEditor::erase_turned_shells() {
  bp::erase_turned_shells(mesh_, sense_);
}

void ProxyEditor::erase_inner_shells() {
  bp::erase_inner_shells(mesh_, inwards_, &sense_);
}

/// Boxes of the star's faces, and their points: faces beyond the rim may be nearer now.
void ProxyEditor::update_around(VertexId apex) {
  around_.clear();
  mesh_.for_each_outgoing(apex, [&](HalfEdgeId h) {
    tree_.update(HalfEdgeMesh::face(h));
    around_.push_back(HalfEdgeMesh::face(h));
  });
  mesh_.for_each_outgoing(apex, [&](HalfEdgeId h) {
    const HalfEdgeId across = mesh_.twin(HalfEdgeMesh::next(h));
    if (across == kNoId) return;
    const FaceId beyond = HalfEdgeMesh::face(across);
    if (std::find(around_.begin(), around_.end(), beyond) == around_.end()) around_.push_back(beyond);
  });
  contacts_.hand_over(replaced_, around_);
}

}  // namespace bp
