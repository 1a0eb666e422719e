#pragma once
#include <random>

#include "lib/geometry/triangle_bvh.h"

namespace bp::test {

inline std::vector<TriangleD> random_triangles(unsigned seed, int n, double size) {
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> at(0, 1), by(-size, size);
  std::vector<TriangleD> all;
  for (int i = 0; i < n; ++i) {
    const Vec3d c{at(random), at(random), at(random)};
    TriangleD t;
    for (Vec3d& p : t) p = {c[0] + by(random), c[1] + by(random), c[2] + by(random)};
    all.push_back(t);
  }
  return all;
}

/// Returns the largest distance over a grid of points of t.
inline double sampled(const TriangleD& t, const TriangleBvh& to, int n) {
  double largest = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      Vec3d p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = (i * t[0][k] + j * t[1][k] + (n - i - j) * t[2][k]) / n;
      largest = std::max(largest, to.nearest(p).distance_squared);
    }
  }
  return std::sqrt(largest);
}

}  // namespace bp::test
