// Sources: [Se91] Seidel, small-dimensional linear programming, incremental: if the optimum of the first i constraints
// violates constraint i + 1, the new optimum lies on its boundary, where the problem has one variable less. It carries
// over to convex quadratic objectives, whose minimum over a convex set is on the boundary of the violated constraint
// for the same reason. Constraints are few (about 10), so their order is kept as given: deterministic, no shuffling.
#include "lib/meshing/constrained_minimum.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

constexpr double kEps = 1e-7;  // lattice units; far below the rounding of 1/2 unit that follows

double dot(const Vec3d& a, const Vec3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3d at(const Vec3d& p, double s, const Vec3d& u) {
  return {p[0] + s * u[0], p[1] + s * u[1], p[2] + s * u[2]};
}
Vec3d times(const Quadric& q, const Vec3d& x) {
  return {q.xx * x[0] + q.xy * x[1] + q.xz * x[2], q.xy * x[0] + q.yy * x[1] + q.yz * x[2],
          q.xz * x[0] + q.yz * x[1] + q.zz * x[2]};
}
/// Half of the gradient.
Vec3d gradient(const Quadric& q, const Vec3d& x) {
  const Vec3d ax = times(q, x);
  return {ax[0] + q.bx, ax[1] + q.by, ax[2] + q.bz};
}

Quadric regularised(const Quadric& q, const Vec3d& prior) {
  Quadric r = q;
  const double pull = 1e-3 * (q.xx + q.yy + q.zz) / 3 + 1e-12;
  r.xx += pull, r.yy += pull, r.zz += pull;
  r.bx -= pull * prior[0], r.by -= pull * prior[1], r.bz -= pull * prior[2];
  return r;
}

Vec3d free_minimum(const Quadric& q) {
  const double a = q.yy * q.zz - q.yz * q.yz, b = q.xz * q.yz - q.xy * q.zz, c = q.xy * q.yz - q.xz * q.yy;
  const double det = q.xx * a + q.xy * b + q.xz * c;
  const double d = q.xx * q.zz - q.xz * q.xz, e = q.xy * q.xz - q.xx * q.yz, f = q.xx * q.yy - q.xy * q.xy;
  return {-(a * q.bx + b * q.by + c * q.bz) / det, -(b * q.bx + d * q.by + e * q.bz) / det,
          -(c * q.bx + e * q.by + f * q.bz) / det};
}

/// Minimum on the line p + s u within the half-spaces.
std::optional<Vec3d> on_line(const Quadric& q, const Vec3d& p, const Vec3d& u,
                             std::span<const PlaneConstraint> constraints) {
  double low = -1e300, high = 1e300;
  for (const PlaneConstraint& h : constraints) {
    const double slope = dot(h.n, u), gap = h.d - dot(h.n, p);
    if (std::abs(slope) < 1e-9) {
      if (gap > 1e-4) return std::nullopt;
    } else if (slope > 0) {
      low = std::max(low, gap / slope);
    } else {
      high = std::min(high, gap / slope);
    }
  }
  if (low > high + kEps) return std::nullopt;
  const double s = -dot(gradient(q, p), u) / dot(times(q, u), u);
  return at(p, std::clamp(s, low, std::max(low, high)), u);
}

/// Minimum on the plane n . x = d within the half-spaces.
std::optional<Vec3d> on_plane(const Quadric& q, const PlaneConstraint& plane,
                              std::span<const PlaneConstraint> constraints) {
  const Vec3d& n = plane.n;
  const Vec3d axis = std::abs(n[0]) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  Vec3d u = cross(n, axis);
  const double length = std::sqrt(dot(u, u));
  u = {u[0] / length, u[1] / length, u[2] / length};
  const Vec3d v = cross(n, u), p = {n[0] * plane.d, n[1] * plane.d, n[2] * plane.d};
  const Vec3d g = gradient(q, p), qu = times(q, u), qv = times(q, v);
  const double uu = dot(qu, u), uv = dot(qu, v), vv = dot(qv, v), gu = dot(g, u), gv = dot(g, v);
  const double det = uu * vv - uv * uv;
  Vec3d x = at(at(p, (uv * gv - vv * gu) / det, u), (uv * gu - uu * gv) / det, v);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const PlaneConstraint& h = constraints[i];
    if (dot(h.n, x) >= h.d - kEps) continue;
    const double hu = dot(h.n, u), hv = dot(h.n, v), norm2 = hu * hu + hv * hv;
    if (norm2 < 1e-18) {  // parallel planes: x cannot move towards h
      if (dot(h.n, p) < h.d - 1e-4) return std::nullopt;
      continue;
    }
    const double gap = (h.d - dot(h.n, p)) / norm2, norm = std::sqrt(norm2);
    const Vec3d on = at(at(p, gap * hu, u), gap * hv, v);
    const Vec3d along = at(at({0, 0, 0}, -hv / norm, u), hu / norm, v);
    const auto line = on_line(q, on, along, constraints.first(i));
    if (!line) return std::nullopt;
    x = *line;
  }
  return x;
}

}  // namespace

void Quadric::add_plane(const Vec3d& n, double d, double area) {
  xx += area * n[0] * n[0], xy += area * n[0] * n[1], xz += area * n[0] * n[2];
  yy += area * n[1] * n[1], yz += area * n[1] * n[2], zz += area * n[2] * n[2];
  bx += area * n[0] * d, by += area * n[1] * d, bz += area * n[2] * d;
  c += area * d * d;
  weight += area;
}

void Quadric::add(const Quadric& q) {
  xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
  bx += q.bx, by += q.by, bz += q.bz;
  c += q.c;
  weight += q.weight;
}

Quadric Quadric::about(const Vec3d& p) const {
  Quadric q = *this;
  const Vec3d g = gradient(*this, p);
  q.bx = g[0], q.by = g[1], q.bz = g[2];
  q.c = value(p);
  return q;
}

double Quadric::value(const Vec3d& x) const {
  const Vec3d ax = times(*this, x);
  return dot(ax, x) + 2 * (bx * x[0] + by * x[1] + bz * x[2]) + c;
}

Vec3d minimum(const Quadric& q, const Vec3d& prior) {
  return free_minimum(regularised(q, prior));
}

std::optional<Vec3d> constrained_minimum(const Quadric& q, const Vec3d& prior,
                                         std::span<const PlaneConstraint> constraints) {
  const Quadric r = regularised(q, prior);
  Vec3d x = free_minimum(r);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (dot(constraints[i].n, x) >= constraints[i].d - kEps) continue;
    const auto on = on_plane(r, constraints[i], constraints.first(i));
    if (!on) return std::nullopt;
    x = *on;
  }
  return x;
}

}  // namespace bp
