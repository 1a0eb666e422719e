#include "tests/reference/winding.h"

#include <cmath>

namespace bp::reference {

namespace {

double dot(const Vec3d& a, const Vec3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

double winding_number(std::span<const TriangleD> triangles, const Vec3d& point) {
  double sum = 0;
  for (const TriangleD& t : triangles) {
    Vec3d v[3];
    double length[3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) v[i][k] = t[i][k] - point[k];
      length[i] = std::sqrt(dot(v[i], v[i]));
    }
    const double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                          v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                          v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    const double below = length[0] * length[1] * length[2] + dot(v[0], v[1]) * length[2] + dot(v[1], v[2]) * length[0] +
                         dot(v[2], v[0]) * length[1];
    sum += 2 * std::atan2(volume, below);
  }
  return sum / (4 * 3.14159265358979323846);
}

}  // namespace bp::reference
