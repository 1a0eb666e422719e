#pragma once
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"

/// Small vector helpers over lattice points. Helpers that return integers are exact.
namespace bp {

[[nodiscard]] inline Vec3d to_double(const LatticeCoord& d) {
  return {double(d.x), double(d.y), double(d.z)};
}

/// Returns the nearest integer; halves go away from zero. |x| below 2^63.
[[nodiscard]] inline std::int64_t nearest_integer(double x) {
  const auto whole = std::int64_t(x);
  const double rest = x - double(whole);  // exact
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

/// Returns the nearest lattice point. A point that is too far away, or no number, becomes one at 2^39, as solutions of
/// nearly singular systems do. That is still within the range of the predicates when it is added to a vertex.
[[nodiscard]] inline LatticeCoord rounded(const Vec3d& x) {
  constexpr double kFar = double(std::int64_t(1) << 39);
  const auto round = [](double v) { return nearest_integer(v > -kFar ? (v < kFar ? v : kFar) : -kFar); };
  return {round(x[0]), round(x[1]), round(x[2])};
}

/// Returns the cross product of two edges of a face: twice its area vector, lattice units squared. Exact for edges
/// below 2^30 lattice units.
[[nodiscard]] inline LatticeCoord normal_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  const LatticeCoord u = b - a, v = c - a;
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Returns the area of a face, lattice units squared, in floating point.
[[nodiscard]] inline double area_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  return length(to_double(normal_of(a, b, c))) / 2;
}
/// The width, in lattice units, of a layer around a proxy that counts as its volume, too, so that thin spikes count. It
/// is less than what voxels leave between a proxy and its scene.
constexpr double kSkin = 0.3 * kLatticePerVoxel;

/// Returns the sign of n . d, exact for components below 2^62 in magnitude. If n is the normal of a face and d leads
/// from a corner to a point, it is the point's side of the face.
[[nodiscard]] inline int side_along(const LatticeCoord& n, const LatticeCoord& d) {
  constexpr std::int64_t n_max = std::int64_t(1) << 40, d_max = std::int64_t(1) << 20;  // 3 * 2^60 < 2^63
  // The limit is a power of two: one comparison for three components.
  const auto within = [](const LatticeCoord& v, std::int64_t max) {
    return (std::uint64_t(v.x + max) | std::uint64_t(v.y + max) | std::uint64_t(v.z + max)) < std::uint64_t(2 * max);
  };
  if (within(n, n_max) && within(d, d_max)) return sign_of(n.x * d.x + n.y * d.y + n.z * d.z);
  return sign_of(int128(n.x) * d.x + int128(n.y) * d.y + int128(n.z) * d.z);
}

constexpr double kPerTwiceArea = 3.4641016151377544;  ///< 2 sqrt(3): triangle_quality() of an equilateral triangle is 1

/// Returns the quality of a triangle: 4 sqrt(3) area over the sum of its squared edges. 1: equilateral, 0: collinear.
[[nodiscard]] inline double triangle_quality(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  const Vec3d ab = to_double(b - a), ac = to_double(c - a), bc = to_double(c - b);
  return kPerTwiceArea * length(to_double(normal_of(a, b, c))) / (dot(ab, ab) + dot(ac, ac) + dot(bc, bc));
}

/// The lowest triangle_quality() that a step may leave. Needles jam the steps that follow. But where faces are bad
/// already, a step may keep about their quality, or they would never go. The sides of a thin plate get worse as it gets
/// thinner.
struct QualityFloor {
  static constexpr double kFlat = 0.02;  ///< merging flat regions, whose faces go soon
  static constexpr double kCollapse =
      0.05;  ///< collapses: the lowest quality accepted, or half of the quality of the worst replaced face
  static constexpr double kDraw =
      0.05;  ///< vertices that move to a surface: the same, or the quality of the worst replaced face
  static constexpr double kEdit =
      0.08;  ///< shrinking a proxy: the lowest quality accepted, or half of the quality of the worst replaced face
};

}  // namespace bp
