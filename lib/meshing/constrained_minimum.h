#pragma once
#include <optional>
#include <span>

#include "lib/core/coords.h"

/// Small convex quadratic programs: minimise x'Ax + 2 b'x over the x with n_i . x >= d_i, in three variables.
/// Seidel's incremental scheme [Se91]: expected linear in the number of constraints.
namespace bp {

/// A quadratic form about a point of its own: value(x) = x'Ax + 2 b'x + c, with x relative to that point. Quadrics of
/// [GH97] are sums of squared distances to planes, each weighted by its triangle's area; `weight` sums the areas.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  double bx = 0, by = 0, bz = 0;
  double c = 0;
  double weight = 0;

  /// Adds area * (n . x + d)^2.
  void add_plane(const Vec3d& n, double d, double area);
  void add(const Quadric& q);
  /// The same function about the point `p` (given relative to the present one).
  [[nodiscard]] Quadric about(const Vec3d& p) const;
  [[nodiscard]] double value(const Vec3d& x) const;
};

/// The half-space n . x >= d; n has unit length.
struct PlaneConstraint {
  Vec3d n;
  double d;
};

/// Point that minimises `q`, pulled slightly (a share 1e-3 of the mean eigenvalue) towards `prior` so that flat
/// directions have one answer.
[[nodiscard]] Vec3d minimum(const Quadric& q, const Vec3d& prior);

/// The same under the constraints; nothing if they contradict each other. Rounded: the caller checks exactly.
[[nodiscard]] std::optional<Vec3d> constrained_minimum(const Quadric& q, const Vec3d& prior,
                                                       std::span<const PlaneConstraint> constraints);

}  // namespace bp
