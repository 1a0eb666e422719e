#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "lib/core/coords.h"
#include "lib/core/host_device.h"
#include "lib/grid/scale_field.h"

/// Cubes with an orientation of their own at each voxel, as the structuring element of a dilation ([CB17] §3.3). Only
/// the hierarchical collision on a GPU closes with them (gpu/hierarchical_kernels.h); decided in integers like
/// all else.
namespace bp {

constexpr int kRotationBits = 14;

/// The cube's axes as rows, times 2^14. What is rounded is the cube: all that decide about it decide alike.
struct Rotation {
  std::int16_t row[3][3] = {{1 << kRotationBits, 0, 0}, {0, 1 << kRotationBits, 0}, {0, 0, 1 << kRotationBits}};
};

/// The rotation of a quaternion of any length but zero.
[[nodiscard]] inline Rotation rotation_of(double w, double x, double y, double z) {
  const double n = w * w + x * x + y * y + z * z;
  const double m[3][3] = {{n - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                          {2 * (x * y + z * w), n - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                          {2 * (x * z - y * w), 2 * (y * z + x * w), n - 2 * (x * x + y * y)}};
  Rotation r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.row[i][j] = std::int16_t(std::lround(m[i][j] / n * (1 << kRotationBits)));
  }
  return r;
}

/// True if the cube of scale `s` around a voxel holds the voxel (x, y, z) away from it: |row . (x, y, z)| <= s for each
/// row.
[[nodiscard]] BP_HD inline bool in_oriented_cube(const Rotation& r, Scale s, std::int32_t x, std::int32_t y,
                                                 std::int32_t z) {
  for (const auto& row : r.row) {
    const std::int64_t along = std::int64_t(row[0]) * x + std::int64_t(row[1]) * y + std::int64_t(row[2]) * z;
    const std::int64_t limit = std::int64_t(s) * ((1 << kRotationBits) / kScaleOne);
    if (along > limit || along < -limit) return false;
  }
  return true;
}

/// Farthest that such a cube reaches along an axis: less than sqrt(3) S + 1, for rows of length 1 - 2^-12 or more.
[[nodiscard]] BP_HD constexpr std::int32_t oriented_reach(Scale s) {
  return std::int32_t(s) * 1775 / 1024 / kScaleOne + 1;
}

/// One rotation for each cell of 8^3 voxels, cells as those of ScaleLattice.
struct RotationLattice {
  VoxelCoord origin, size;  ///< in cells; x fastest
  std::vector<Rotation> cells;

  [[nodiscard]] const Rotation& at(VoxelCoord p) const {
    const std::int32_t x = floor_div(p.x, kScaleStep) - origin.x, y = floor_div(p.y, kScaleStep) - origin.y,
                       z = floor_div(p.z, kScaleStep) - origin.z;
    return cells[(std::size_t(z) * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x) + std::size_t(x)];
  }
};

}  // namespace bp
