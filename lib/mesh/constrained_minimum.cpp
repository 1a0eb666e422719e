// Source: [Se91] Seidel, small-dimensional linear programming, incremental. If the optimum of the first i constraints
// violates constraint i + 1, the new optimum lies on its boundary, where the problem has one variable less. The same
// holds for convex quadratic objectives, whose minimum over a convex set then lies on that boundary, too. Constraints
// are few (about 10), so they are taken in the given order: deterministic, no shuffling.
#include "lib/mesh/constrained_minimum.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kEps = 1e-7;  // lattice units; far below the rounding of 1/2 unit that follows

Vec3d at(const Vec3d& p, double s, const Vec3d& u) {
  return {p[0] + s * u[0], p[1] + s * u[1], p[2] + s * u[2]};
}
/// Returns the minimum on the line p + s u within the half-spaces.
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
  const double s = -dot(q.gradient(p), u) / dot(q.times(u), u);
  return at(p, std::clamp(s, low, std::max(low, high)), u);
}

/// Returns the minimum on the plane n . x = d within the half-spaces.
std::optional<Vec3d> on_plane(const Quadric& q, const PlaneConstraint& plane,
                              std::span<const PlaneConstraint> constraints) {
  const Vec3d& n = plane.n;
  const Vec3d axis = std::abs(n[0]) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  Vec3d u = cross(n, axis);
  const double length = std::sqrt(dot(u, u));
  u = {u[0] / length, u[1] / length, u[2] / length};
  const Vec3d v = cross(n, u), p = {n[0] * plane.d, n[1] * plane.d, n[2] * plane.d};
  const Vec3d g = q.gradient(p), qu = q.times(u), qv = q.times(v);
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

GrowingMinimum::GrowingMinimum(const Quadric& q, const Vec3d& prior)
    : regularised_(q.regularised(prior)), x_(regularised_.minimum()) {}

std::optional<Vec3d> GrowingMinimum::under(std::span<const PlaneConstraint> constraints) {
  for (; known_ < constraints.size(); ++known_) {
    if (dot(constraints[known_].n, x_) >= constraints[known_].d - kEps) continue;
    const auto on = on_plane(regularised_, constraints[known_], constraints.first(known_));
    if (!on) return std::nullopt;
    x_ = *on;
  }
  return x_;
}

std::optional<Vec3d> constrained_minimum(const Quadric& q, const Vec3d& prior,
                                         std::span<const PlaneConstraint> constraints) {
  return GrowingMinimum(q, prior).under(constraints);
}

}  // namespace bp
