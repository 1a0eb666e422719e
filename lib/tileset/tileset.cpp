#include "lib/tileset/tileset.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kRounding = 1e-12;  // for rotations whose numbers are doubles

/// Returns the images of the axes.
std::array<Vec3d, 3> columns_of(const Transform& m) {
  return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}};
}

/// Returns a - b, rounded up.
double difference_up(double a, double b) {
  const double d = a - b, back = d - a, error = (a - (d - back)) - (b + back);  // two_diff()
  return error > 0 ? std::nextafter(d, HUGE_VAL) : d;
}

}  // namespace

std::array<Vec3d, 8> TileBox::corners() const {
  std::array<Vec3d, 8> all;
  for (std::size_t i = 0; i < 8; ++i) {
    all[i] = centre;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sign = (i >> axis & 1) != 0 ? 1 : -1;
      for (std::size_t k = 0; k < 3; ++k) all[i][k] += sign * axes[axis][k];
    }
  }
  return all;
}

TileBox box_of(const Bounds3d& bounds) {
  TileBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.centre[i] = bounds.min[i] + (bounds.max[i] - bounds.min[i]) / 2;
    box.axes[i][i] = std::max(difference_up(bounds.max[i], box.centre[i]), difference_up(box.centre[i], bounds.min[i]));
  }
  return box;
}

Transform product(const Transform& a, const Transform& b) {
  Transform m{};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k) m[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return m;
}

double largest_scale(const Transform& m) {
  double largest = 0;
  for (const Vec3d& column : columns_of(m)) largest = std::max(largest, length(column));
  return std::abs(largest - 1) <= kRounding ? 1 : largest;
}

bool keeps_spheres(const Transform& m) {
  const std::array<Vec3d, 3> columns = columns_of(m);
  const double square = dot(columns[0], columns[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &a = columns[i], &b = columns[(i + 1) % 3];
    if (std::abs(dot(a, a) - square) > kRounding * square || std::abs(dot(a, b)) > kRounding * square) return false;
  }
  return true;
}

Vec3d transformed(const Transform& m, const Vec3d& p) {
  Vec3d out;
  for (std::size_t row = 0; row < 3; ++row)
    out[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
  return out;
}

}  // namespace bp
