#pragma once
#include "lib/core/coords.h"
#include "lib/core/up_axis.h"

namespace bp {

/// Affine map of points, in double: rows of a 3 x 4 matrix. A product of scale and translation alone applies exactly
/// wherever the result is a double, since the terms of the other axes are zeros.
struct Affine {
  std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  [[nodiscard]] Vec3d operator()(const Vec3d& p) const {
    return {((m[0][0] * p[0] + m[0][1] * p[1]) + m[0][2] * p[2]) + m[0][3],
            ((m[1][0] * p[0] + m[1][1] * p[1]) + m[1][2] * p[2]) + m[1][3],
            ((m[2][0] * p[0] + m[2][1] * p[1]) + m[2][2] * p[2]) + m[2][3]};
  }
  /// First b, then a.
  friend Affine operator*(const Affine& a, const Affine& b) {
    Affine product;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        product.m[i][j] = (a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j]) + a.m[i][2] * b.m[2][j];
      }
      product.m[i][3] += a.m[i][3];
    }
    return product;
  }
  /// Of a surface's normal, of any length; the outside stays outside.
  [[nodiscard]] Vec3d normal(const Vec3d& n) const {
    const double sign = mirrors() ? -1 : 1;
    Vec3d out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &b = m[(i + 1) % 3], &c = m[(i + 2) % 3];
      out[i] = sign * ((b[1] * c[2] - b[2] * c[1]) * n[0] + (b[2] * c[0] - b[0] * c[2]) * n[1] +
                       (b[0] * c[1] - b[1] * c[0]) * n[2]);
    }
    return out;
  }
  /// True if it turns the outside of a mesh into its inside.
  [[nodiscard]] bool mirrors() const {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
  }
};

/// Exact.
[[nodiscard]] inline Affine affine_of(const AxisTurn& turn) {
  Affine a;
  a.m = {};
  for (std::size_t i = 0; i < 3; ++i) a.m[i][turn.axis[i]] = turn.negative[i] ? -1 : 1;
  return a;
}

/// Translation after rotation (a quaternion x y z w of any length but 0) after scale.
[[nodiscard]] inline Affine affine_of(const Vec3d& t, const std::array<double, 4>& q, const Vec3d& s) {
  const double x = q[0], y = q[1], z = q[2], w = q[3], square = x * x + y * y + z * z + w * w;
  const double two = square > 0 ? 2 / square : 0;
  const std::array<std::array<double, 3>, 3> r{
      {{1 - two * (y * y + z * z), two * (x * y - z * w), two * (x * z + y * w)},
       {two * (x * y + z * w), 1 - two * (x * x + z * z), two * (y * z - x * w)},
       {two * (x * z - y * w), two * (y * z + x * w), 1 - two * (x * x + y * y)}}};
  Affine a;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a.m[i][j] = r[i][j] * s[j];
    a.m[i][3] = t[i];
  }
  return a;
}

}  // namespace bp
