// The constraint that the merged vertex lies on or outside the plane of every face around the edge: [SGG00], [DLCW11].
#include "lib/simplify/detail/edge_star.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/mesh/step_limits.h"

namespace bp {

namespace {

constexpr double kLeastTurn = 0.1;  // cosine between a face's normal before and after

}  // namespace

void EdgeStar::gather(const HalfEdgeMesh& mesh, HalfEdgeId h) {
  faces_.clear();
  ring_.clear();
  kept_ = mesh.from(h);
  origin_ = mesh.position(kept_);
  gather_fan(mesh, h, mesh.to(h), true);
  ring_split_ = ring_.size();
  gather_fan(mesh, mesh.twin(h), kept_, false);
}

/// Gathers the faces around from(first). Each spoke's end is the second corner of the face before it: its position is
/// read once. `both`: with the two faces at the edge.
void EdgeStar::gather_fan(const HalfEdgeMesh& mesh, HalfEdgeId first, VertexId other, bool both) {
  const LatticeCoord apex = mesh.position(mesh.from(first)) - origin_;
  LatticeCoord a = mesh.position(other) - origin_;  // the fan begins at the edge itself
  HalfEdgeId g = first;
  do {
    const VertexId to = mesh.to(g), next = mesh.opposite(g);
    const LatticeCoord b = mesh.position(next) - origin_;
    const bool lost = to == other || next == other;
    if (to != kept_) ring_.push_back(to);
    if (both || !lost) {
      faces_.push_back({HalfEdgeMesh::face(g), to, next, apex, a, b, {}, lost});
      faces_.back().normal = normal_of(apex, a, b);
    }
    a = b;
    g = mesh.rotate(g);
  } while (g != first);
}

LatticeBox EdgeStar::box() const {
  LatticeBox box{origin_, origin_};
  for (const Face& f : faces_) box.add(origin_ + f.apex);
  return box;
}

bool EdgeStar::link_holds() const {
  const auto split = ring_.begin() + std::ptrdiff_t(ring_split_);
  std::ptrdiff_t common = 0;
  for (auto v = split; v != ring_.end(); ++v) common += std::count(ring_.begin(), split, *v);
  return common == 2 && !(ring_split_ == 3 && ring_.size() == 5);  // neighbours: 3 and 2, less from(h)
}

void EdgeStar::constrain(std::vector<PlaneConstraint>& constraints) const {
  constraints.clear();
  for (const Face& f : faces_) {
    const Vec3d n = to_double(f.normal);
    const double size = length(n);
    const Vec3d unit = {n[0] / size, n[1] / size, n[2] / size};
    const double d = dot(unit, to_double(f.apex));
    const bool known = !constraints.empty() && dot(constraints.back().n, unit) > 1 - 1e-12 &&
                       std::abs(constraints.back().d - d) < 1e-6;
    if (!known) constraints.push_back({unit, d});
  }
}

Vec3d pushed_out(const EdgeStar& star, const Vec3d& x, const std::vector<PlaneConstraint>& constraints) {
  Vec3d mean{};
  for (const EdgeStar::Face& f : star.faces()) {
    const Vec3d n = to_double(f.normal);
    for (std::size_t i = 0; i < 3; ++i) mean[i] += n[i];
  }
  const double size = length(mean);
  if (size == 0) return x;
  for (double& m : mean) m /= size;
  double depth = 0;
  for (const PlaneConstraint& s : constraints) {
    const double slope = dot(s.n, mean);
    if (slope > 0.2) depth = std::max(depth, (s.d - dot(s.n, x)) / slope);
  }
  return {x[0] + depth * mean[0], x[1] + depth * mean[1], x[2] + depth * mean[2]};
}

std::optional<LatticeCoord> EdgeStar::round_inside(const Vec3d& x, const Quadric& q) const {
  const LatticeCoord near = rounded(x);
  if (outside_all(near)) return near;
  LatticeCoord low = near;  // the floor, within what predicates take
  for (int i = 0; i < 3; ++i) low[i] -= double(low[i]) > x[std::size_t(i)] ? 1 : 0;
  std::optional<LatticeCoord> best;
  double best_cost = 0;
  for (int i = 0; i < 8; ++i) {
    const LatticeCoord p = low + LatticeCoord{i & 1, (i >> 1) & 1, i >> 2};
    const double cost = q.value(to_double(p));
    if ((!best || cost < best_cost) && outside_all(p)) {
      best = p;
      best_cost = cost;
    }
  }
  return best;
}

bool EdgeStar::outside_all(const LatticeCoord& p) const {
  return std::all_of(faces_.begin(), faces_.end(),
                     [&](const Face& f) { return side_along(f.normal, p - f.apex) >= 0; });
}

bool shape_is_fine(const EdgeStar& star, const LatticeCoord& p) {
  double after = 1;  // least |cross product|^2 / (sum of squared edges)^2
  for (const EdgeStar::Face& f : star.faces()) {
    if (f.lost) continue;
    const LatticeCoord a = f.pa - p, b = f.pb - p, e = f.pb - f.pa;
    const Vec3d n0 = to_double(f.normal), n1 = to_double(normal_of(p, f.pa, f.pb));
    const double along = dot(n0, n1), squared = dot(n1, n1);
    if (along <= 0 || along * along < kLeastTurn * kLeastTurn * dot(n0, n0) * squared) return false;
    const double edges = double(a.x * a.x + a.y * a.y + a.z * a.z) + double(b.x * b.x + b.y * b.y + b.z * b.z) +
                         double(e.x * e.x + e.y * e.y + e.z * e.z);
    after = std::min(after, squared / (edges * edges));
  }
  const double quality = std::sqrt(12 * after);
  if (quality >= QualityFloor::kCollapse) return true;
  double before = 1;
  for (const EdgeStar::Face& f : star.faces()) before = std::min(before, triangle_quality(f.apex, f.pa, f.pb));
  return quality >= before / 2;
}

double EdgeStar::growth6(const LatticeCoord& p) const {
  double gain6 = 0;
  for (const Face& f : faces_) gain6 += dot(to_double(f.normal), to_double(p - f.apex));
  return gain6;
}

void EdgeStar::fan_to(const LatticeCoord& p, std::vector<NewFace>& fan, std::vector<FaceId>& replaced) const {
  fan.clear();
  replaced.clear();
  for (const Face& f : faces_) {
    replaced.push_back(f.face);
    if (!f.lost) fan.push_back({{kept_, f.a, f.b}, {origin_ + p, origin_ + f.pa, origin_ + f.pb}});
  }
}

void EdgeStar::swept_to(const LatticeCoord& p, std::vector<Tetrahedron>& swept) const {
  swept.clear();
  for (const Face& f : faces_) {
    if (side_along(f.normal, p - f.apex) < 0)
      swept.push_back({origin_ + f.apex, origin_ + f.pa, origin_ + f.pb, origin_ + p});
  }
}

bool EdgeStar::lies_between(const LatticeCoord& three, const LatticeCoord& p) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const Face& s) {
    const LatticeCoord apex = s.apex * 3, a = s.pa * 3, b = s.pb * 3, top = p * 3;
    return side_along(s.normal, three - apex) >= 0 && side_along(s.normal, top - apex) > 0 &&
           orient3d(apex, b, top, three) >= 0 && orient3d(b, a, top, three) >= 0 && orient3d(a, apex, top, three) >= 0;
  });
}

}  // namespace bp
