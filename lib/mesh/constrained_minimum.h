#pragma once
#include <optional>
#include <span>

#include "lib/mesh/quadric.h"

/// Small convex quadratic programs: minimise x'Ax + 2 b'x over the x with n_i . x >= d_i, in three variables.
/// Seidel's incremental scheme [Se91]: expected linear in the number of constraints.
namespace bp {

/// The half-space n . x >= d; n has unit length.
struct PlaneConstraint {
  Vec3d n;
  double d;
};

/// Point that minimises `q`, regularised, under the constraints; nothing if they contradict each other. Rounded: the
/// caller checks exactly.
[[nodiscard]] std::optional<Vec3d> constrained_minimum(const Quadric& q, const Vec3d& prior,
                                                       std::span<const PlaneConstraint> constraints);

/// The same, where constraints are added and the point is asked for again: what it was before is not sought again.
class GrowingMinimum {
 public:
  GrowingMinimum(const Quadric& q, const Vec3d& prior);
  /// For `constraints`, which begin with those of the last call. Nothing as soon as they contradict each other.
  [[nodiscard]] std::optional<Vec3d> under(std::span<const PlaneConstraint> constraints);

 private:
  Quadric regularised_;
  Vec3d x_;
  std::size_t known_ = 0;  // constraints that x_ keeps
};

}  // namespace bp
