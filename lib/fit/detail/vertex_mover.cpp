#include "lib/fit/detail/vertex_mover.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

constexpr double kLeastTurn = 0.3;  // cosine between a face's normal before and after

LatticeCoord part_of_way(const LatticeCoord& p, const LatticeCoord& q, double share) {
  return {p.x + std::llround(share * double(q.x - p.x)), p.y + std::llround(share * double(q.y - p.y)),
          p.z + std::llround(share * double(q.z - p.z))};
}

}  // namespace

Vec3d vertex_normal(const HalfEdgeMesh& mesh, VertexId v) {
  Vec3d sum{};
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) {
    const Vec3d n = to_double(normal_of(mesh.position(v), mesh.position(mesh.to(h)), mesh.position(mesh.opposite(h))));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += n[i];
  });
  const double l = length(sum);
  if (l > 0) {
    for (double& x : sum) x /= l;
  }
  return sum;
}

bool VertexMover::draw(VertexId v, const LatticeCoord& q) {
  const LatticeCoord p = mesh_.position(v);
  for (const double share : {1.0, 0.5, 0.25}) {
    const LatticeCoord at = part_of_way(p, q, share);
    if (at == p) return false;
    if (try_move(v, at)) return true;
  }
  return false;
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
  if (!fine || after < std::min(QualityFloor::kDraw, before) || !guard_.star_is_free(star_, replaced_)) return false;
  const int128 gain6 = fan_gain6(mesh_, replaced_, q);
  if (sense_.turns(replaced_.front(), gain6) || !within_limits(limits_, mesh_, replaced_, star_)) return false;
  sense_.add(replaced_.front(), gain6);
  mesh_.move(v, q);
  for (const FaceId f : replaced_) tree_.update(f);
  return true;
}

}  // namespace bp
