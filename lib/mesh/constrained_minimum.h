#pragma once
#include <optional>
#include <span>

#include "lib/mesh/quadric.h"

/// Small convex quadratic programs: minimise x'Ax + 2 b'x over all x with n_i . x >= d_i, in three variables, by
/// Seidel's incremental scheme [Se91]. The expected time is linear in the number of constraints.
namespace bp {

/// The half-space n . x >= d, where n has unit length.
struct PlaneConstraint {
  Vec3d n;
  double d;
};

/// Returns the point that minimises `q`, regularised, under the constraints; nothing if they contradict each other. The
/// point is rounded, so the caller checks it exactly.
[[nodiscard]] std::optional<Vec3d> constrained_minimum(const Quadric& q, const Vec3d& prior,
                                                       std::span<const PlaneConstraint> constraints);

/// Finds the same minimum again and again while constraints are added. It goes on from the last point.
class GrowingMinimum {
 public:
  GrowingMinimum(const Quadric& q, const Vec3d& prior);
  /// Returns the minimum under `constraints`, which must begin with those of the last call; nothing once they
  /// contradict each other.
  [[nodiscard]] std::optional<Vec3d> under(std::span<const PlaneConstraint> constraints);

 private:
  Quadric regularised_;
  Vec3d x_;
  std::size_t known_ = 0;  // constraints that x_ keeps
};

}  // namespace bp
