#pragma once
#include <cmath>
#include <cstdlib>

#include "lib/core/coords.h"

/// Exact geometric predicates. Each returns a sign (-1, 0, +1) that is the sign of the real-number determinant of the
/// coordinates as given: no tolerance, no failure.
///
/// Convention:
///   orient3d(a, b, c, d) > 0  iff  ((b - a) x (c - a)) . (d - a) > 0:
///     d lies on the side of the plane abc that the normal of the counter-clockwise triangle abc points to; for a
///     triangle of an outward oriented surface that is outside.
///   orient2d(a, b, c, axis) > 0  iff  a, b, c turn counter-clockwise after dropping `axis`, seen against that axis
///     (axis 2: from +z, in the x-y plane; axis 0: y-z plane; axis 1: z-x plane).
///
/// Domain:
///   LatticeCoord  |coordinate| <= 2^40. Differences are at most 2^41, the six products of a determinant at most 2^123,
///                 their sum below 2^126: a 128-bit integer holds it. (A grid of 2^31 voxels needs 2^37.)
///   Vec3d         Each coordinate is zero or between 1e-90 and 1e90 in magnitude. Such a number, hence each
///                 difference, is a multiple of 2^-351. Each term of a determinant is a multiple of 2^-1053 and below
///                 1e272. Nothing underflows or overflows, so the transformations below are free of error. Outside the
///                 domain the sign is arbitrary; in_predicate_domain() tells.
/// Doubles assume rounding to nearest and no contraction of a*b+c (-ffp-contract=off).
namespace bp {

__extension__ typedef __int128 int128;

/// Returns true if the predicates are exact for coordinate `x`. NaN and infinities give false.
[[nodiscard]] inline bool in_predicate_domain(double x) {
  const double m = std::abs(x);
  return x == 0 || (m >= 1e-90 && m <= 1e90);
}
[[nodiscard]] inline bool in_predicate_domain(const Vec3d& p) {
  return in_predicate_domain(p[0]) && in_predicate_domain(p[1]) && in_predicate_domain(p[2]);
}

template <class T>
[[nodiscard]] constexpr int sign_of(T x) {
  return int(x > 0) - int(x < 0);
}

namespace detail {

/// Decides by expansion arithmetic: slow and certain. It is called if the filter cannot decide.
[[nodiscard]] int orient3d_exact(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);
[[nodiscard]] int orient2d_exact(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis);

/// Returns true if all of x, y, z are in [-2^20, 2^20). Then products of three fit in 64 bits.
constexpr bool short_vector(const LatticeCoord& v) {
  constexpr std::int64_t half = std::int64_t(1) << 20;
  return std::uint64_t(v.x + half) < 2 * half && std::uint64_t(v.y + half) < 2 * half &&
         std::uint64_t(v.z + half) < 2 * half;
}

/// Returns u x v . w. |result| <= 6 max|u| max|v| max|w|.
template <class Int>
constexpr Int triple_product(const LatticeCoord& u, const LatticeCoord& v, const LatticeCoord& w) {
  return (Int(u.y) * v.z - Int(u.z) * v.y) * w.x + (Int(u.z) * v.x - Int(u.x) * v.z) * w.y +
         (Int(u.x) * v.y - Int(u.y) * v.x) * w.z;
}

}  // namespace detail

/// Returns the determinant itself: six times the signed volume of the tetrahedron, in cubed lattice units.
[[nodiscard]] constexpr int128 orient3d_value(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c,
                                              const LatticeCoord& d) {
  return detail::triple_product<int128>(b - a, c - a, d - a);
}

[[nodiscard]] constexpr int orient3d(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c,
                                     const LatticeCoord& d) {
  const LatticeCoord u = b - a, v = c - a, w = d - a;
  if (detail::short_vector(u) && detail::short_vector(v) && detail::short_vector(w))  // 6 * 2^60 < 2^63
    return sign_of(detail::triple_product<std::int64_t>(u, v, w));
  return sign_of(detail::triple_product<int128>(u, v, w));
}

[[nodiscard]] constexpr int orient2d(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return sign_of(int128(b[i] - a[i]) * (c[j] - a[j]) - int128(b[j] - a[j]) * (c[i] - a[i]));
}

/// The plane of three points, for many queries: side(d) is orient3d(a, b, c, d), exactly.
template <class P>
class PlaneOf {
 public:
  constexpr PlaneOf(const P& a, const P& b, const P& c) : a_(a), b_(b), c_(c) {}
  [[nodiscard]] constexpr int side(const P& d) const { return orient3d(a_, b_, c_, d); }

 private:
  P a_, b_, c_;
};

/// The filter. Each of the six terms of the computed determinant passes through at most 8 roundings (three differences,
/// two products, the difference of two products, two additions). So with u = 2^-53
///   |computed - exact| <= ((1 + u)^8 - 1) * (sum of the exact |terms|) <= ((1 + u)^8 - 1) / (1 - u)^8 * permanent
/// for the permanent as computed. That factor is below 8.00001 u, and 9 u also covers the rounding of the bound. If the
/// bound underflows (permanent below 2^-1000), the terms are multiples of 2^-1053 with at most 53 bits, and the
/// determinant is computed without any error.
template <>
class PlaneOf<Vec3d> {
 public:
  PlaneOf(const Vec3d& a, const Vec3d& b, const Vec3d& c) : a_(a), b_(b), c_(c) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
    normal_ = {yz - zy, zx - xz, xy - yx};
    size_ = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
  }
  [[nodiscard]] int side(const Vec3d& d) const {
    const double wx = d[0] - a_[0], wy = d[1] - a_[1], wz = d[2] - a_[2];
    const double det = normal_[0] * wx + normal_[1] * wy + normal_[2] * wz;
    const double permanent = size_[0] * std::abs(wx) + size_[1] * std::abs(wy) + size_[2] * std::abs(wz);
    const double bound = 9 * 0x1p-53 * permanent;
    if (det > bound) return 1;
    if (-det > bound) return -1;
    if (permanent == 0) return 0;  // each term is exactly zero
    return detail::orient3d_exact(a_, b_, c_, d);
  }

 private:
  Vec3d a_, b_, c_, normal_, size_;  // size_: of the terms of the normal
};

[[nodiscard]] inline int orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return PlaneOf<Vec3d>(a, b, c).side(d);
}

/// The filter is the one above, with 4 roundings a term (two differences, a product, an addition). 5 u also covers the
/// rounding of the bound.
[[nodiscard]] inline int orient2d(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const std::size_t i = std::size_t(axis + 1) % 3, j = std::size_t(axis + 2) % 3;
  const double l = (b[i] - a[i]) * (c[j] - a[j]), r = (b[j] - a[j]) * (c[i] - a[i]);
  const double det = l - r, bound = 5 * 0x1p-53 * (std::abs(l) + std::abs(r));
  if (det > bound) return 1;
  if (-det > bound) return -1;
  if (l == 0 && r == 0) return 0;
  return detail::orient2d_exact(a, b, c, axis);
}

/// Returns true if a, b, c lie on one line or coincide: the triangle has exactly zero area.
template <class P>
[[nodiscard]] bool collinear(const P& a, const P& b, const P& c) {
  return orient2d(a, b, c, 2) == 0 && orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0;
}

}  // namespace bp
