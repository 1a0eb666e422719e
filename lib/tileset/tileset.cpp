#include "lib/tileset/tileset.h"

#include <algorithm>

namespace bp {

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
    box.axes[i][i] = std::max(bounds.max[i] - box.centre[i], box.centre[i] - bounds.min[i]);
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

Vec3d transformed(const Transform& m, const Vec3d& p) {
  Vec3d out;
  for (std::size_t row = 0; row < 3; ++row)
    out[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
  return out;
}

}  // namespace bp
