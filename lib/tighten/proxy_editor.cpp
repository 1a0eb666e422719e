#include "lib/tighten/proxy_editor.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/mesh/shells.h"

namespace bp {

namespace {

constexpr double kOverhang = 0.1;  // of the star's middle side: how far beyond its box an apex may go

/// A fin has next to no volume and well-shaped faces: what betrays it is an apex far from all that was there. Along the
/// edge of a plate stars are long, and what is far there is told by how thick they are.
bool sticks_out(const LatticeCoord& apex, const LatticeBox& star) {
  std::array<double, 3> sides{};
  double over = 0;
  for (int i = 0; i < 3; ++i) {
    sides[std::size_t(i)] = double(star.max[i] - star.min[i]);
    over = std::max({over, double(apex[i] - star.max[i]), double(star.min[i] - apex[i])});
  }
  std::sort(sides.begin(), sides.end());
  return over > kOverhang * sides[1];
}

}  // namespace

ProxyEditor::ProxyEditor(HalfEdgeMesh& mesh, const Enclosed& enclosed, const ShapeLimits& limits)
    : mesh_(mesh),
      enclosed_(enclosed),
      edge_limit_(limits.edge_limit),
      limits_(limits.limits),
      inwards_(faces_inwards(mesh)),
      room_(intersect(mesh.room(), limits.room)),
      first_reach_(limits.reach),
      reach_(limits.reach),
      tree_(mesh),
      guard_(mesh, tree_),
      sense_(mesh),
      contacts_(enclosed, mesh, tree_) {
  if (limits_ != nullptr) limits_->begin(mesh.volume6());
}

void ProxyEditor::begin() {
  ++counts_.tries;
  blocked_ = false;
  faces_.clear();
  replaced_.clear();
  swept_.clear();
  least_quality_ = 1;
  star_ = {};
}

void ProxyEditor::add_old_face(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c,
                               const LatticeCoord& to) {
  least_quality_ = std::min(least_quality_, triangle_quality(a, b, c));
  if (replaced_.size() == 1) star_ = {a, a};
  for (const LatticeCoord& p : {a, b, c}) star_.add(p);
  if (orient3d(a, b, c, to) < 0) swept_.push_back({a, b, c, to});
}

/// New edges run from the first to the second corner of each new face.
bool ProxyEditor::shape_is_fine() {
  const double floor = std::min(QualityFloor::kEdit, least_quality_);
  for (const NewFace& f : faces_) {
    const double quality = triangle_quality(f.corners[0], f.corners[1], f.corners[2]);
    if (quality == 0 || quality < floor) {
      ++counts_.refused[Refusal::shape];
      return false;
    }
  }
  const bool too_long = edge_limit_ && std::any_of(faces_.begin(), faces_.end(), [&](const NewFace& f) {
                          return !edge_limit_(f.corners[0], f.corners[1]);
                        });
  counts_.refused[Refusal::length] += too_long;
  return !too_long;
}

bool ProxyEditor::keeps_enclosed() {
  if (enclosed_.allows(faces_, swept_, &blocker_)) return true;
  ++counts_.refused[Refusal::enclosed];
  blocked_ = true;
  const Vec3d origin = to_double(contacts_.origin());
  for (std::size_t i = 0; i < blocker_.count; ++i) blocker_.points[i] = blocker_.points[i] - origin;
  return false;
}

/// The last question, given the guard's answer: limits count what they allow as taken. All new faces together are a fan
/// around the first one's first corner, a flip's, too, if flat faces count.
bool ProxyEditor::is_free(bool free) {
  const bool within = free && within_limits(limits_, mesh_, replaced_, faces_);
  counts_.refused[Refusal::guard] += !free;
  counts_.refused[Refusal::limits] += free && !within;
  if (within) sense_.add(replaced_.front(), fan_gain6(mesh_, replaced_, faces_[0].corners[0]));
  return within;
}

/// What goes inwards everywhere does not leave what is enclosed.
bool ProxyEditor::stays_near() {
  if (reach_ == 0 || swept_.size() == replaced_.size()) return true;
  const bool near = enclosed_.is_near(faces_, reach_);
  counts_.refused[Refusal::growth] += !near;
  counts_.beyond_reach += !near;
  return near;
}

bool ProxyEditor::loosen() {
  if (reach_ == 0 || counts_.beyond_reach == beyond_reach_before_) return false;
  beyond_reach_before_ = counts_.beyond_reach;
  reach_ = loosened(reach_, first_reach_);
  return true;
}

bool ProxyEditor::fan_is_fine(const LatticeCoord& apex) {
  const bool within = room_.holds_inside(apex);
  if (!within || sticks_out(apex, star_)) {
    ++counts_.refused[within ? Refusal::shape : Refusal::growth];
    return false;
  }
  if (!shape_is_fine() || !keeps_enclosed() || !stays_near()) return false;
  return is_free(guard_.star_is_free(faces_, replaced_));
}

bool ProxyEditor::move(VertexId v, const LatticeCoord& to) {
  begin();
  const LatticeCoord p = mesh_.position(v);
  mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
    const VertexId a = mesh_.to(h), b = mesh_.opposite(h);
    const LatticeCoord &pa = mesh_.position(a), &pb = mesh_.position(b);
    faces_.push_back({{v, a, b}, {to, pa, pb}});
    replaced_.push_back(HalfEdgeMesh::face(h));
    add_old_face(p, pa, pb, to);
  });
  if (!fan_is_fine(to)) return false;
  mesh_.move(v, to);
  update_around(v);
  return true;
}

bool ProxyEditor::collapse(HalfEdgeId h, const LatticeCoord& to) {
  if (!mesh_.can_collapse(h)) return false;
  begin();
  const VertexId u = mesh_.from(h), w = mesh_.to(h);
  const auto add = [&](HalfEdgeId g) {
    const VertexId a = mesh_.to(g), b = mesh_.opposite(g);
    const LatticeCoord &pa = mesh_.position(a), &pb = mesh_.position(b);
    replaced_.push_back(HalfEdgeMesh::face(g));
    add_old_face(mesh_.position(mesh_.from(g)), pa, pb, to);
    if (a != w && b != w) faces_.push_back({{u, a, b}, {to, pa, pb}});
  };
  mesh_.for_each_outgoing(u, add);
  mesh_.for_each_outgoing(w, [&](HalfEdgeId g) {
    if (mesh_.to(g) != u && mesh_.opposite(g) != u) add(g);
  });
  if (!fan_is_fine(to)) return false;
  for (const HalfEdgeId g : {h, mesh_.twin(h)}) tree_.remove(HalfEdgeMesh::face(g));
  mesh_.collapse(h, to);
  update_around(u);
  tree_.maintain();
  return true;
}

/// A contact point of the faces replaced is surely outside of both faces of the edge ab: refuses most flips before the
/// exact test. Points a unit deep count, for they are rounded.
bool ProxyEditor::cuts_off_contacts(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& u,
                                    const LatticeCoord& w) const {
  const Vec3d at = to_double(a - contacts_.origin());
  Vec3d nu = to_double(normal_of(b, a, u)), nw = to_double(normal_of(a, b, w));
  const double au = length(nu), aw = length(nw);
  for (const FaceId f : replaced_) {
    for (const std::uint32_t i : contacts_.of(f)) {
      const Vec3d p = contacts_[i] - at;
      if (dot(nu, p) > au && dot(nw, p) > aw) return true;
    }
  }
  return false;
}

bool ProxyEditor::is_convex(HalfEdgeId h) const {
  return orient3d(mesh_.position(mesh_.from(h)), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h)),
                  mesh_.position(mesh_.opposite(mesh_.twin(h)))) < 0;
}

bool ProxyEditor::flip(HalfEdgeId h) {
  if (!mesh_.can_flip(h)) return false;
  begin();
  const HalfEdgeId t = mesh_.twin(h);
  const VertexId u = mesh_.from(h), w = mesh_.to(h), a = mesh_.opposite(h), b = mesh_.opposite(t);
  const LatticeCoord &pu = mesh_.position(u), &pw = mesh_.position(w), &pa = mesh_.position(a), &pb = mesh_.position(b);
  faces_ = {{{b, a, u}, {pb, pa, pu}}, {{a, b, w}, {pa, pb, pw}}};
  replaced_ = {HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  add_old_face(pu, pw, pa, pb);
  least_quality_ = std::min(least_quality_, triangle_quality(pw, pu, pb));
  if (cuts_off_contacts(pa, pb, pu, pw)) {
    ++counts_.refused[Refusal::enclosed];
    return false;
  }
  if (!shape_is_fine() || !keeps_enclosed() || (swept_.empty() && !stays_near()) ||
      !is_free(guard_.faces_are_free(faces_, replaced_)))
    return false;
  mesh_.flip(h);
  for (const FaceId f : replaced_) tree_.update(f);
  contacts_.hand_over(replaced_, replaced_);
  return true;
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
