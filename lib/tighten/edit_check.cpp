#include "lib/tighten/edit_check.h"

#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/mesh/step_limits.h"

namespace bp {

namespace {

constexpr double kOverhang = 0.1;  // share of the middle side of the star's box by which an apex may lie beyond it

/// Returns whether the apex makes a fin. A fin has almost no volume and well-shaped faces, but its apex lies far from
/// all old faces. The distance is compared with the middle side of the star's box, since stars are long at the edge of
/// a plate.
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

EditCheck::EditCheck(const EditedProxy& proxy) : proxy_(proxy), mesh_(proxy.mesh), guard_(proxy.mesh, proxy.tree) {}

void EditCheck::begin() {
  ++counts.tries;
  blocked_ = false;
  faces_.clear();
  replaced_.clear();
  swept_.clear();
  least_quality_ = 1;
  star_ = {};
}

void EditCheck::add_old_face(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c,
                             const LatticeCoord& to) {
  least_quality_ = std::min(least_quality_, triangle_quality(a, b, c));
  if (replaced_.size() == 1) star_ = {a, a};
  for (const LatticeCoord& p : {a, b, c}) star_.add(p);
  if (orient3d(a, b, c, to) < 0) swept_.push_back({a, b, c, to});
}

void EditCheck::put_boxes(EditBoxes& boxes) const {
  boxes.clear();
  for (const NewFace& f : faces_) boxes.add(box_of(f.corners[0], f.corners[1], f.corners[2]));
}

/// Returns whether no new face is a needle and no new edge too long. New edges run from the first to the second corner
/// of each new face.
bool EditCheck::shape_is_fine() {
  const double floor = std::min(QualityFloor::kEdit, least_quality_ / 2);
  for (const NewFace& f : faces_) {
    const double quality = triangle_quality(f.corners[0], f.corners[1], f.corners[2]);
    if (quality == 0 || quality < floor) {
      ++counts.refused[Refusal::shape];
      return false;
    }
  }
  const bool too_long = proxy_.edge_limit && std::any_of(faces_.begin(), faces_.end(), [&](const NewFace& f) {
                          return !proxy_.edge_limit(f.corners[0], f.corners[1]);
                        });
  counts.refused[Refusal::length] += too_long;
  return !too_long;
}

bool EditCheck::keeps_enclosed() {
  // Clears what an earlier check of this thread has seen, so that the result does not depend on threads.
  blocker_.count = 0;
  if (proxy_.enclosed.allows(faces_, swept_, &blocker_)) return true;
  ++counts.refused[Refusal::enclosed];
  blocked_ = true;
  const Vec3d origin = to_double(proxy_.contacts.origin());
  for (std::size_t i = 0; i < blocker_.count; ++i) blocker_.points[i] = blocker_.points[i] - origin;
  return false;
}

/// Returns whether the change is free and within the limits. `free`: the guard's answer. It must be the last test,
/// since limits count what they allow as taken.
bool EditCheck::is_free(bool free) {
  const bool within = free && within_limits(proxy_.limits, mesh_, replaced_, faces_);
  counts.refused[Refusal::guard] += !free;
  counts.refused[Refusal::limits] += free && !within;
  return within;
}

/// Returns whether the new faces stay within reach. A change that only goes inwards is not tested, since it cannot
/// leave what is enclosed.
bool EditCheck::stays_near() {
  if (proxy_.reach_units == 0 || swept_.size() == replaced_.size()) return true;
  const bool near = proxy_.enclosed.is_near(faces_, proxy_.reach_units);
  counts.refused[Refusal::growth] += !near;
  counts.beyond_reach += !near;
  return near;
}

bool EditCheck::fan_is_fine(const LatticeCoord& apex) {
  const bool within = proxy_.room.holds_inside(apex);
  if (!within || sticks_out(apex, star_)) {
    ++counts.refused[within ? Refusal::shape : Refusal::growth];
    return false;
  }
  if (!shape_is_fine() || !keeps_enclosed() || !stays_near()) return false;
  return is_free(guard_.star_is_free(faces_, replaced_));
}

/// Returns whether a contact point of the replaced faces surely lies outside both faces of the edge ab. This refuses
/// most flips before the exact test. Only points a unit deep count, since they are rounded.
bool EditCheck::cuts_off_contacts(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& u,
                                  const LatticeCoord& w) const {
  const Vec3d at = to_double(a - proxy_.contacts.origin());
  Vec3d nu = to_double(normal_of(b, a, u)), nw = to_double(normal_of(a, b, w));
  const double au = length(nu), aw = length(nw);
  for (const FaceId f : replaced_) {
    for (const std::uint32_t i : proxy_.contacts.of(f)) {
      const Vec3d p = proxy_.contacts[i] - at;
      if (dot(nu, p) > au && dot(nw, p) > aw) return true;
    }
  }
  return false;
}

bool EditCheck::allows_move(VertexId v, const LatticeCoord& to) {
  begin();
  const LatticeCoord p = mesh_.position(v);
  mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
    const VertexId a = mesh_.to(h), b = mesh_.opposite(h);
    const LatticeCoord &pa = mesh_.position(a), &pb = mesh_.position(b);
    faces_.push_back({{v, a, b}, {to, pa, pb}});
    replaced_.push_back(HalfEdgeMesh::face(h));
    add_old_face(p, pa, pb, to);
  });
  return fan_is_fine(to);
}

bool EditCheck::allows_collapse(HalfEdgeId h, const LatticeCoord& to) {
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
  return fan_is_fine(to);
}

bool EditCheck::allows_flip(HalfEdgeId h) {
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
    ++counts.refused[Refusal::enclosed];
    return false;
  }
  return shape_is_fine() && keeps_enclosed() && (!swept_.empty() || stays_near()) &&
         is_free(guard_.faces_are_free(faces_, replaced_));
}

bool EditCheck::allows_cut(HalfEdgeId h) {
  const HalfEdgeId t = mesh_.twin(h);
  const VertexId v = mesh_.opposite(h), a = mesh_.from(h), b = mesh_.to(h);
  const HalfEdgeId to_b = mesh_.twin(HalfEdgeMesh::next(h));
  const VertexId w = mesh_.opposite(to_b), x = mesh_.opposite(t);
  const bool any_locked = mesh_.locked(a) || mesh_.locked(b) || mesh_.locked(w) || mesh_.locked(x);
  if (any_locked || x == w || mesh_.valence(a) < 5 || mesh_.valence(b) < 5) return false;
  if (mesh_.are_joined(w, x)) return false;
  begin();
  const LatticeCoord &pv = mesh_.position(v), &pa = mesh_.position(a), &pb = mesh_.position(b), &pw = mesh_.position(w),
                     &px = mesh_.position(x);
  faces_ = {{{w, a, x}, {pw, pa, px}}, {{w, x, b}, {pw, px, pb}}};
  mesh_.for_each_outgoing(v, [&](HalfEdgeId g) { replaced_.push_back(HalfEdgeMesh::face(g)); });
  replaced_.push_back(HalfEdgeMesh::face(t));
  add_old_face(pv, pa, pb, pw);
  add_old_face(pb, pa, px, pw);
  return shape_is_fine() && keeps_enclosed() && stays_near() && is_free(guard_.faces_are_free(faces_, replaced_));
}

}  // namespace bp
