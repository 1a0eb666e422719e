#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "lib/core/coords.h"
#include "lib/core/up_axis.h"

namespace bp {

/// A sum in double, from left to right, and a bound on its rounding: 0 if it is exact. The error of a product is a
/// double, unless it underflows, and so is that of a sum.
struct RoundedSum {
  double value = 0, off = 0;

  /// Adds a * b. `off_a`, `off_b`: bounds on the errors of a and b.
  void add_product(double a, double off_a, double b, double off_b) {
    const double product = a * b;
    off += std::abs(std::fma(a, b, -product)) + std::abs(a) * off_b + off_a * (std::abs(b) + off_b);
    if (std::abs(product) < 0x1p-900 && a != 0 && b != 0) off += 0x1p-1000;
    add(product);
  }
  void add(double x) {
    const double sum = value + x, part = sum - value;
    off += std::abs((value - (sum - part)) + (x - part));
    value = sum;
  }
  /// Returns the bound, with the rounding of the bound itself.
  [[nodiscard]] double bound() const { return off * (1 + 0x1p-40); }
};

/// A point, and a bound on its error along each axis.
struct PlacedPoint {
  Vec3d point{};
  double off = 0;
};

/// Bounds on the errors of a 3 x 4 matrix's numbers. Scenes have many transforms, and most of them are exact: these
/// take only a pointer.
class MatrixBounds {
 public:
  MatrixBounds() = default;
  MatrixBounds(MatrixBounds&&) noexcept = default;
  MatrixBounds& operator=(MatrixBounds&&) noexcept = default;
  MatrixBounds(const MatrixBounds& o) : all_(o.all_ ? std::make_unique<Numbers>(*o.all_) : nullptr) {}
  MatrixBounds& operator=(const MatrixBounds& o) { return *this = MatrixBounds(o); }
  ~MatrixBounds() = default;

  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const { return all_ ? (*all_)[i][j] : 0; }
  void set(std::size_t i, std::size_t j, double off) {
    if (off == (*this)(i, j)) return;
    if (!all_) all_ = std::make_unique<Numbers>();
    (*all_)[i][j] = off;
  }
  void add(std::size_t i, std::size_t j, double off) { set(i, j, (*this)(i, j) + off); }
  [[nodiscard]] bool any() const {
    return all_ && std::any_of(all_->begin(), all_->end(), [](const auto& row) {
             return std::any_of(row.begin(), row.end(), [](double off) { return off != 0; });
           });
  }

 private:
  using Numbers = std::array<std::array<double, 4>, 3>;
  std::unique_ptr<Numbers> all_;  // null: all are 0
};

/// An affine map of points, in double: rows of a 3 x 4 matrix. A product of scale and translation alone applies exactly
/// wherever the result is a double, since the terms of the other axes are zeros.
struct Affine {
  std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  /// Bounds on the difference of each number from that of the map that a file describes. Products keep them up to date.
  MatrixBounds off{};

  /// Adds this share of each number to the bounds.
  void blur(double share) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) off.add(i, j, share * std::abs(m[i][j]));
    }
  }
  /// As operator(), for a point with an error of at most `off_p` along each axis.
  [[nodiscard]] PlacedPoint place(const Vec3d& p, double off_p) const {
    PlacedPoint out;
    for (std::size_t i = 0; i < 3; ++i) {
      RoundedSum sum;
      for (std::size_t j = 0; j < 3; ++j) sum.add_product(m[i][j], off(i, j), p[j], off_p);
      sum.add(m[i][3]);
      out.point[i] = sum.value;
      out.off = std::max(out.off, sum.bound() + off(i, 3) * (1 + 0x1p-40));
    }
    return out;
  }

  [[nodiscard]] Vec3d operator()(const Vec3d& p) const {
    return {((m[0][0] * p[0] + m[0][1] * p[1]) + m[0][2] * p[2]) + m[0][3],
            ((m[1][0] * p[0] + m[1][1] * p[1]) + m[1][2] * p[2]) + m[1][3],
            ((m[2][0] * p[0] + m[2][1] * p[1]) + m[2][2] * p[2]) + m[2][3]};
  }
  /// Returns the map that applies b, then a.
  friend Affine operator*(const Affine& a, const Affine& b) {
    Affine product;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        RoundedSum sum;
        for (std::size_t k = 0; k < 3; ++k) sum.add_product(a.m[i][k], a.off(i, k), b.m[k][j], b.off(k, j));
        if (j == 3) {
          sum.add(a.m[i][3]);
          sum.off += a.off(i, 3);
        }
        product.m[i][j] = sum.value;
        product.off.set(i, j, sum.bound());
      }
    }
    return product;
  }
  /// Maps a surface's normal, of any length; it still points outwards.
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
  /// Returns true if the map turns the outside of a mesh into its inside.
  [[nodiscard]] bool mirrors() const {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
  }
};

/// Returns the exact map of a turn.
[[nodiscard]] inline Affine affine_of(const AxisTurn& turn) {
  Affine a;
  a.m = {};
  for (std::size_t i = 0; i < 3; ++i) a.m[i][turn.axis[i]] = turn.negative[i] ? -1 : 1;
  return a;
}

/// Returns whether a quaternion has the length 1 of one that only turns, to the precision of bytes, as the validator of
/// glTF has it. Programs disagree on others: some make them as long, some let them scale and skew.
[[nodiscard]] inline bool is_unit_rotation(const std::array<double, 4>& q) {
  constexpr double kMostOff = 0.00769;
  return std::abs(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) - 1) <= kMostOff;
}

/// Returns translation after rotation (a quaternion x y z w of any length but 0) after scale. A quaternion without
/// rotation leaves all numbers exact; otherwise a number of the rotation has some 10 roundings, of terms up to 2. Some
/// programs do not make a quaternion as long as 1 that is nearly so. The difference counts as rounding, too, unless
/// only digits of a float32 are missing.
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
  if (x == 0 && y == 0 && z == 0) return a;
  constexpr double kFloat = 0x1p-20;
  const double unequal = std::abs(square - 1),
               off = 0x1p-48 + (unequal > kFloat && is_unit_rotation(q) ? 2 * unequal : 0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a.off.set(i, j, off * std::abs(s[j]));
  }
  return a;
}

}  // namespace bp
