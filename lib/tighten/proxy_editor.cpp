#include "lib/tighten/proxy_editor.h"

#include <algorithm>
#include <array>

#include "lib/exact/predicates.h"
#include "lib/mesh/step_limits.h"

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
      check_(proxy_),
      settlers_([] { return std::make_unique<Settler>(); }) {
  if (limits.limits != nullptr) limits.limits->begin(mesh.volume6());
}

bool ProxyEditor::loosen() {
  if (reach_ == 0 || check_.counts.beyond_reach == beyond_reach_before_) return false;
  beyond_reach_before_ = check_.counts.beyond_reach;
  reach_ = loosened(reach_, first_reach_);
  proxy_.enclosed.expect_near(reach_);
  return true;
}

bool ProxyEditor::move(VertexId v, const LatticeCoord& to) {
  if (!check_.allows_move(v, to)) return false;
  make_move(v, to);
  settle_points();
  return true;
}

bool ProxyEditor::collapse(HalfEdgeId h, const LatticeCoord& to) {
  if (!check_.allows_collapse(h, to)) return false;
  make_collapse(h, to);
  settle_points();
  return true;
}

bool ProxyEditor::flip(HalfEdgeId h) {
  if (!check_.allows_flip(h)) return false;
  make_flip(h);
  settle_points();
  return true;
}

bool ProxyEditor::cut(HalfEdgeId h) {
  if (!check_.allows_cut(h)) return false;
  const HalfEdgeId beyond = mesh_.twin(h);
  // The half-edge from the vertex to its third neighbour.
  const HalfEdgeId out = mesh_.rotate(mesh_.twin(HalfEdgeMesh::next(h)));
  const HalfEdgeId in = mesh_.twin(out);
  // The cut is made in two steps. A shell that does not turn in the end must not turn between them.
  const std::array<FaceId, 1> spike{HalfEdgeMesh::face(h)};
  if (sense_.turns(spike[0], fan_gain6(mesh_, spike, mesh_.position(mesh_.from(in))))) return false;
  make_collapse(in, mesh_.position(mesh_.from(in)));
  make_flip(beyond);
  settle_points();
  return true;
}

void ProxyEditor::begin_undo() {
  tree_.maintain();
  undo_.emplace().face_count = mesh_.face_count();
}

void ProxyEditor::undo() {
  mesh_.restore(*undo_);
  for (const HalfEdgeMesh::Undo::Half& half : undo_->halves) {
    if (half.h % 3 == 0) tree_.update(HalfEdgeMesh::face(half.h));
  }
  begin_undo();
}

/// Saves the faces around vertices if changes are recorded.
void ProxyEditor::save(std::initializer_list<VertexId> vertices) {
  if (!undo_) return;
  for (const VertexId v : vertices) mesh_.save(v, *undo_);
}

/// Records that the faces are replaced by a fan around `apex`.
ProxyEditor::Unsettled& ProxyEditor::replace(std::span<const FaceId> faces, const LatticeCoord& apex) {
  sense_.add(faces.front(), fan_gain6(mesh_, faces, apex));
  if (unsettled_count_ == unsettled_.size()) unsettled_.emplace_back();
  Unsettled& some = unsettled_[unsettled_count_++];
  some.from.assign(faces.begin(), faces.end());
  some.apex = kNoId;
  return some;
}

void ProxyEditor::make_move(VertexId v, const LatticeCoord& to) {
  save({v});
  replaced_.clear();
  mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { replaced_.push_back(HalfEdgeMesh::face(h)); });
  replace(replaced_, to).apex = v;
  mesh_.move(v, to);
  for (const FaceId f : replaced_) tree_.update(f);
}

void ProxyEditor::make_collapse(HalfEdgeId h, const LatticeCoord& to) {
  const VertexId u = mesh_.from(h), w = mesh_.to(h);
  save({u, w});
  replaced_.clear();
  mesh_.for_each_outgoing(u, [&](HalfEdgeId g) { replaced_.push_back(HalfEdgeMesh::face(g)); });
  mesh_.for_each_outgoing(w, [&](HalfEdgeId g) {
    if (mesh_.to(g) != u && mesh_.opposite(g) != u) replaced_.push_back(HalfEdgeMesh::face(g));
  });
  replace(replaced_, to).apex = u;
  for (const HalfEdgeId g : {h, mesh_.twin(h)}) tree_.remove(HalfEdgeMesh::face(g));
  mesh_.collapse(h, to);
  mesh_.for_each_outgoing(u, [&](HalfEdgeId g) { tree_.update(HalfEdgeMesh::face(g)); });
  if (!undo_) tree_.maintain();
}

/// Flips the edge. The new faces are a fan around one end of the new edge, if faces without area are counted.
void ProxyEditor::make_flip(HalfEdgeId h) {
  save({mesh_.from(h), mesh_.to(h)});
  const HalfEdgeId t = mesh_.twin(h);
  const std::array<FaceId, 2> faces{HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  replace(faces, mesh_.position(mesh_.opposite(t)));
  mesh_.flip(h);
  for (const FaceId f : faces) tree_.update(f);
}

void ProxyEditor::settle_points() {
  constexpr std::size_t kPerThread = 4;
  settlers_.for_each(unsettled_count_, kPerThread,
                     [&](Settler& settler, std::size_t i) { settle(unsettled_[i], settler); });
  unsettled_count_ = 0;
}

/// Settles the points of all changed faces with one search, which is less work than one after each change if neighbours
/// have changed, too.
void ProxyEditor::settle_points_of_many() {
  replaced_.clear();
  for (std::size_t i = 0; i < unsettled_count_; ++i)
    replaced_.insert(replaced_.end(), unsettled_[i].from.begin(), unsettled_[i].from.end());
  unsettled_count_ = 0;
  std::sort(replaced_.begin(), replaced_.end());
  replaced_.erase(std::unique(replaced_.begin(), replaced_.end()), replaced_.end());
  contacts_.hand_over_around(replaced_);
}

/// Lists the points of the old faces with the nearest of the new ones. After a change of a star, faces beyond its rim
/// may be nearer, too.
void ProxyEditor::settle(const Unsettled& some, Settler& settler) {
  if (some.apex == kNoId) return contacts_.hand_over(some.from, some.from, settler.scratch);
  std::vector<FaceId>& around = settler.around;
  around.clear();
  mesh_.for_each_outgoing(some.apex, [&](HalfEdgeId h) { around.push_back(HalfEdgeMesh::face(h)); });
  mesh_.for_each_outgoing(some.apex, [&](HalfEdgeId h) {
    const HalfEdgeId across = mesh_.twin(HalfEdgeMesh::next(h));
    if (across == kNoId) return;
    const FaceId beyond = HalfEdgeMesh::face(across);
    if (std::find(around.begin(), around.end(), beyond) == around.end()) around.push_back(beyond);
  });
  contacts_.hand_over(some.from, around, settler.scratch);
}

bool ProxyEditor::is_convex(HalfEdgeId h) const {
  return orient3d(mesh_.position(mesh_.from(h)), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h)),
                  mesh_.position(mesh_.opposite(mesh_.twin(h)))) < 0;
}

void ProxyEditor::learn(VertexId v, std::span<const Vec3d> points) {
  around_.clear();
  mesh_.for_each_outgoing(v, [&](HalfEdgeId g) { around_.push_back(HalfEdgeMesh::face(g)); });
  contacts_.add(points, to_double(mesh_.position(v) - contacts_.origin()), around_);
}

void ProxyEditor::erase_turned_shells() {
  bp::erase_turned_shells(mesh_, sense_);
}

void ProxyEditor::erase_inner_shells() {
  bp::erase_inner_shells(mesh_, inwards_, &sense_);
}

}  // namespace bp
