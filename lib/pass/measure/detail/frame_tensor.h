#pragma once
#include <array>
#include <vector>

#include "lib/core/coords.h"

/// Frames modulo the 24 rotations of a cube onto itself, as sums of the fourth powers of directions. Sums and averages
/// of these have a meaning; those of quaternions have none.
namespace bp::detail {

/// The rows are the axes.
using Frame = std::array<Vec3d, 3>;

/// The sum of w (n x)^4 as a polynomial in x: the coefficients of its 15 monomials, without the multinomials.
struct FrameTensor {
  static constexpr std::size_t kParts = 15;
  std::array<double, kParts> m{};

  void add(const Vec3d& n, double w);
  void add(const Frame& frame, double w) {
    for (const Vec3d& axis : frame) add(axis, w);
  }
  /// Returns the gradient at x, divided by 4: the sum of w (n x)^3 n.
  [[nodiscard]] Vec3d gradient(const Vec3d& x) const;
};

/// Returns the frame that fits best: it has the largest sum over its axes of the polynomial, by ascents from fixed
/// starts.
[[nodiscard]] Frame best_frame(const FrameTensor& tensor);

/// Returns the 24 rotations of the frame's cube, as quaternions w, x, y, z of length 1 whose largest part is positive.
[[nodiscard]] std::vector<std::array<double, 4>> turns_of(const Frame& frame);

/// Returns the rotation that turns least.
[[nodiscard]] std::array<double, 4> least_turn(const Frame& frame);

/// Returns the cosine of the largest angle between an axis of `a` and the axis of `b` nearest to it.
[[nodiscard]] double likeness(const Frame& a, const Frame& b);

}  // namespace bp::detail
