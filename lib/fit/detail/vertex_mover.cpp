#include "lib/fit/detail/vertex_mover.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/mesh/step_limits.h"

namespace bp {

namespace {

constexpr double kLeastTurn = 0.3;  // cosine between a face's normal before and after

LatticeCoord part_of_way(const LatticeCoord& p, const LatticeCoord& q, double share) {
  return {p.x + std::llround(share * double(q.x - p.x)), p.y + std::llround(share * double(q.y - p.y)),
          p.z + std::llround(share * double(q.z - p.z))};
}

}  // namespace

bool VertexMover::draw(VertexId v, const LatticeCoord& q) {
  const LatticeCoord p = mesh_.position(v);
  for (const double share : {1.0, 0.5, 0.25}) {
    const LatticeCoord at = part_of_way(p, q, share);
    if (at == p) return false;
    if (try_move(v, at)) return true;
  }
  return false;
}

bool VertexMover::flip(HalfEdgeId h) {
  if (!mesh_.can_flip(h)) return false;
  const HalfEdgeId t = mesh_.twin(h);
  const VertexId u = mesh_.from(h), w = mesh_.to(h), a = mesh_.opposite(h), b = mesh_.opposite(t);
  const LatticeCoord &pu = mesh_.position(u), &pw = mesh_.position(w), &pa = mesh_.position(a), &pb = mesh_.position(b);
  star_ = {{{b, a, u}, {pb, pa, pu}}, {{a, b, w}, {pa, pb, pw}}};
  replaced_ = {HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  const Vec3d before = to_double(normal_of(pu, pw, pa)) + to_double(normal_of(pw, pu, pb));
  const double quality = std::min(triangle_quality(pu, pw, pa), triangle_quality(pw, pu, pb));
  for (const NewFace& f : star_) {
    const Vec3d n = to_double(normal_of(f.corners[0], f.corners[1], f.corners[2]));
    const double after = triangle_quality(f.corners[0], f.corners[1], f.corners[2]);
    if (!(dot(n, before) > 0) || after < std::min(QualityFloor::kDraw, quality)) return false;
  }
  if ((edge_limit_ && !edge_limit_(pa, pb)) || !guard_.faces_are_free(star_, replaced_)) return false;
  const int128 gain6 = fan_gain6(mesh_, replaced_, pb);
  if (sense_.turns(replaced_.front(), gain6) || !stays_near()) return false;
  if (!within_limits(limits_, mesh_, replaced_, star_)) return false;
  sense_.add(replaced_.front(), gain6);
  mesh_.flip(h);
  for (const FaceId f : replaced_) tree_.update(f);
  return true;
}

bool VertexMover::try_move(VertexId v, const LatticeCoord& q) {
  if (!room_.holds_inside(q)) return false;
  star_.clear();
  replaced_.clear();
  bool fine = true;
  double before = 1, after = 1;
  const LatticeCoord p = mesh_.position(v);
  mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
    const LatticeCoord a = mesh_.position(mesh_.to(h)), b = mesh_.position(mesh_.opposite(h));
    const Vec3d n0 = to_double(normal_of(p, a, b)), n1 = to_double(normal_of(q, a, b));
    const double l1 = dot(n1, n1);
    fine =
        fine && (!edge_limit_ || edge_limit_(q, a)) && l1 > 0 && dot(n0, n1) > kLeastTurn * std::sqrt(dot(n0, n0) * l1);
    before = std::min(before, triangle_quality(p, a, b));
    after = std::min(after, triangle_quality(q, a, b));
    star_.push_back({{v, mesh_.to(h), mesh_.opposite(h)}, {q, a, b}});
    replaced_.push_back(HalfEdgeMesh::face(h));
  });
  if (!fine || after < std::min(QualityFloor::kDraw, before)) return false;
  if (!guard_.star_is_free(star_, replaced_)) return false;
  const int128 gain6 = fan_gain6(mesh_, replaced_, q);
  if (sense_.turns(replaced_.front(), gain6) || !stays_near()) return false;
  if (!within_limits(limits_, mesh_, replaced_, star_)) return false;
  sense_.add(replaced_.front(), gain6);
  mesh_.move(v, q);
  for (const FaceId f : replaced_) tree_.update(f);
  return true;
}

}  // namespace bp
