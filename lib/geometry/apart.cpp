// The directions tried are those of separating axes: across a triangle, across an edge of each, within a triangle's
// plane across its edges, and from corner to corner. The nearest points of a corner and an edge alone may lie along
// another one.
#include "lib/geometry/apart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kOfSize = 1e-13;  // of the triangles' size: a dozen roundings of doubles, and more

class Pair {
 public:
  Pair(const TriangleD& a, const TriangleD& b, double distance) {
    for (std::size_t k = 0; k < 3; ++k) a_[k] = a[k] - a[0], b_[k] = b[k] - a[0];
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max({size, length(a_[k]), length(b_[k])});
    distance_ = distance + kOfSize * size;
  }

  [[nodiscard]] bool is_apart() const {
    const std::array<Vec3d, 3> u = edges_of(a_), v = edges_of(b_);
    const Vec3d m = cross(u[0], u[1]), n = cross(v[0], v[1]);
    if (parts(m) || parts(n)) return true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (parts(cross(u[i], m)) || parts(cross(v[i], n))) return true;
      for (std::size_t j = 0; j < 3; ++j) {
        if (parts(cross(u[i], v[j])) || parts(b_[j] - a_[i])) return true;
      }
    }
    return false;
  }

 private:
  static std::array<Vec3d, 3> edges_of(const TriangleD& t) { return {t[1] - t[0], t[2] - t[1], t[0] - t[2]}; }

  /// Returns whether the triangles lie beyond two planes across the direction, so far apart.
  [[nodiscard]] bool parts(const Vec3d& across) const {
    const Vec3d direction = with_largest_one(across);
    const double size = length(direction);
    if (!(size > 0)) return false;
    const auto [a_low, a_high] = extent(a_, direction);
    const auto [b_low, b_high] = extent(b_, direction);
    return std::max(b_low - a_high, a_low - b_high) > distance_ * size;
  }
  static std::array<double, 2> extent(const TriangleD& t, const Vec3d& n) {
    const double x = dot(n, t[0]), y = dot(n, t[1]), z = dot(n, t[2]);
    return {std::min({x, y, z}), std::max({x, y, z})};
  }

  TriangleD a_, b_;
  double distance_;
};

}  // namespace

bool are_apart(const TriangleD& a, const TriangleD& b, double distance) {
  return Pair(a, b, distance).is_apart();
}

}  // namespace bp
