#pragma once
#include <cmath>
#include <limits>

#include "lib/core/coords.h"

/// Arithmetic of Vec3d. Each component is rounded by itself.
namespace bp {

[[nodiscard]] inline Vec3d operator+(const Vec3d& a, const Vec3d& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline Vec3d operator-(const Vec3d& a, const Vec3d& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Vec3d operator*(double s, const Vec3d& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
[[nodiscard]] inline double dot(const Vec3d& a, const Vec3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double length(const Vec3d& v) {
  return std::sqrt(dot(v, v));
}
/// Returns `v` scaled to length 1, or `otherwise` if `v` has no direction.
[[nodiscard]] inline Vec3d unit(const Vec3d& v, const Vec3d& otherwise) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : otherwise;
}
/// Returns `v` over the size of its largest component, so that squares neither vanish nor overflow; zero stays zero.
[[nodiscard]] inline Vec3d with_largest_one(const Vec3d& v) {
  double largest = 0;
  for (const double x : v) largest = x > largest ? x : -x > largest ? -x : largest;
  return largest > 0 ? Vec3d{v[0] / largest, v[1] / largest, v[2] / largest} : v;
}
[[nodiscard]] inline double area_of(const TriangleD& t) {
  return length(cross(t[1] - t[0], t[2] - t[0])) / 2;
}
[[nodiscard]] inline bool is_finite(const Vec3d& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}
/// Returns whether all coordinates are finite. It has no branches, since it runs for every triangle that is read.
[[nodiscard]] inline bool is_finite(const TriangleD& t) {
  bool finite = true;
  for (const Vec3d& p : t) {
    for (const double c : p) finite &= std::abs(c) <= std::numeric_limits<double>::max();
  }
  return finite;
}

}  // namespace bp
