#pragma once
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"

/// Small vector helpers over lattice points. Exact where they return integers.
namespace bp {

[[nodiscard]] inline Vec3d to_double(const LatticeCoord& d) {
  return {double(d.x), double(d.y), double(d.z)};
}

/// The nearest integer, halves away from zero; |x| below 2^63.
[[nodiscard]] inline std::int64_t nearest_integer(double x) {
  const auto whole = std::int64_t(x);
  const double rest = x - double(whole);  // exact
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

/// The nearest lattice point; one at 2^39 for what is farther away or no number, as solutions of nearly singular
/// systems are: still within the range of the predicates when it is added to a vertex.
[[nodiscard]] inline LatticeCoord rounded(const Vec3d& x) {
  constexpr double kFar = double(std::int64_t(1) << 39);
  const auto round = [](double v) { return nearest_integer(v > -kFar ? (v < kFar ? v : kFar) : -kFar); };
  return {round(x[0]), round(x[1]), round(x[2])};
}

/// Cross product of two edges of a face: twice its area vector, lattice units squared. Exact for edges below 2^30
/// lattice units.
[[nodiscard]] inline LatticeCoord normal_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  const LatticeCoord u = b - a, v = c - a;
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Of a face, lattice units squared; in floating point.
[[nodiscard]] inline double area_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  return length(to_double(normal_of(a, b, c))) / 2;
}
/// Lattice units around a proxy that count as its volume, too, where a thin spike shall count: less than what voxels
/// leave between a proxy and its scene.
constexpr double kSkin = 0.3 * kLatticePerVoxel;

/// Sign of n . d, exact for components below 2^62 in magnitude: with n the normal of a face and d from one of its
/// corners to a point, the point's side of the face.
[[nodiscard]] inline int side_along(const LatticeCoord& n, const LatticeCoord& d) {
  constexpr std::int64_t n_max = std::int64_t(1) << 40, d_max = std::int64_t(1) << 20;  // 3 * 2^60 < 2^63
  const auto within = [](const LatticeCoord& v, std::int64_t max) {  // a power of two: one comparison for three
    return (std::uint64_t(v.x + max) | std::uint64_t(v.y + max) | std::uint64_t(v.z + max)) < std::uint64_t(2 * max);
  };
  if (within(n, n_max) && within(d, d_max)) return sign_of(n.x * d.x + n.y * d.y + n.z * d.z);
  return sign_of(int128(n.x) * d.x + int128(n.y) * d.y + int128(n.z) * d.z);
}

constexpr double kPerTwiceArea = 3.4641016151377544;  ///< 2 sqrt(3): triangle_quality() of an equilateral triangle is 1

/// Shape of a triangle: 4 sqrt(3) area over the sum of its squared edges; 1 if equilateral, 0 if collinear.
[[nodiscard]] inline double triangle_quality(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  const Vec3d ab = to_double(b - a), ac = to_double(c - a), bc = to_double(c - b);
  return kPerTwiceArea * length(to_double(normal_of(a, b, c))) / (dot(ab, ab) + dot(ac, ac) + dot(bc, bc));
}

/// Floors of triangle_quality(). A step that leaves a worse face is refused, since needles jam the steps that follow;
/// but not where faces are bad already, or they would never go. The sides of a thin plate get worse as it gets thinner.
struct QualityFloor {
  static constexpr double kFlat = 0.02;  ///< merging flat regions; these faces go soon
  static constexpr double kCollapse =
      0.05;  ///< collapses: lowest quality accepted, or half of that of the worst face replaced
  static constexpr double kDraw =
      0.05;  ///< vertices that move to a surface: the same, or that of the worst face replaced
  static constexpr double kEdit =
      0.08;  ///< shrinking a proxy: lowest quality accepted, or half of that of the worst face replaced
};

}  // namespace bp
