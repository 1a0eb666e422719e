#pragma once
#include "lib/core/coords.h"

/// Quadrics of [GH97]: sums of squared distances to planes. All of it is inline, since a collapse needs a dozen of
/// them.
namespace bp {

/// A quadratic form about a point of its own: value(x) = x'Ax + 2 b'x + c, with x relative to that point. Each plane
/// has the area of its triangle as its weight; `weight` is the sum of the areas.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  double bx = 0, by = 0, bz = 0;
  double c = 0;
  double weight = 0;

  /// Adds area * (n . x + d)^2.
  void add_plane(const Vec3d& n, double d, double area) {
    xx += area * n[0] * n[0], xy += area * n[0] * n[1], xz += area * n[0] * n[2];
    yy += area * n[1] * n[1], yz += area * n[1] * n[2], zz += area * n[2] * n[2];
    bx += area * n[0] * d, by += area * n[1] * d, bz += area * n[2] * d;
    c += area * d * d;
    weight += area;
  }
  void add(const Quadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    bx += q.bx, by += q.by, bz += q.bz;
    c += q.c;
    weight += q.weight;
  }
  [[nodiscard]] Vec3d times(const Vec3d& x) const {  ///< A x
    return {xx * x[0] + xy * x[1] + xz * x[2], xy * x[0] + yy * x[1] + yz * x[2], xz * x[0] + yz * x[1] + zz * x[2]};
  }
  [[nodiscard]] Vec3d gradient(const Vec3d& x) const {  ///< half of the gradient
    const Vec3d ax = times(x);
    return {ax[0] + bx, ax[1] + by, ax[2] + bz};
  }
  [[nodiscard]] double value(const Vec3d& x) const {
    const Vec3d ax = times(x);
    return (ax[0] * x[0] + ax[1] * x[1] + ax[2] * x[2]) + 2 * (bx * x[0] + by * x[1] + bz * x[2]) + c;
  }
  /// Returns the same function about the point `p`, which is relative to the present one.
  [[nodiscard]] Quadric about(const Vec3d& p) const {
    Quadric q = *this;
    const Vec3d g = gradient(p);
    q.bx = g[0], q.by = g[1], q.bz = g[2];
    q.c = value(p);
    return q;
  }
  /// Returns the form pulled slightly towards `prior`, by 1e-3 of the mean eigenvalue. Then flat directions have one
  /// answer.
  [[nodiscard]] Quadric regularised(const Vec3d& prior) const {
    Quadric r = *this;
    const double pull = 1e-3 * (xx + yy + zz) / 3 + 1e-12;
    r.xx += pull, r.yy += pull, r.zz += pull;
    r.bx -= pull * prior[0], r.by -= pull * prior[1], r.bz -= pull * prior[2];
    return r;
  }
  /// Returns the point where the form is least. A must be regular.
  [[nodiscard]] Vec3d minimum() const {
    const double a = yy * zz - yz * yz, b = xz * yz - xy * zz, c1 = xy * yz - xz * yy;
    const double det = xx * a + xy * b + xz * c1;
    const double d = xx * zz - xz * xz, e = xy * xz - xx * yz, f = xx * yy - xy * xy;
    return {-(a * bx + b * by + c1 * bz) / det, -(b * bx + d * by + e * bz) / det, -(c1 * bx + e * by + f * bz) / det};
  }
};

/// Returns the point that minimises `q`, regularised.
[[nodiscard]] inline Vec3d minimum(const Quadric& q, const Vec3d& prior) {
  return q.regularised(prior).minimum();
}

}  // namespace bp
