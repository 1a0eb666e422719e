#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/coords.h"
#include "lib/core/host_device.h"
#include "lib/grid/orientation_field.h"
#include "lib/grid/scale_field.h"

/// Cubes with an orientation of their own at each voxel, as the structuring element of a dilation ([CB17] §3.3).
/// Decided in integers like all else.
namespace bp {

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

/// The same of all cubes of a field: at most oriented_reach(), and cube_radius() where none is turned.
[[nodiscard]] std::int32_t oriented_reach(const OrientationField& field, Scale s);

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

/// The rotations of all voxels of a box.
[[nodiscard]] RotationLattice sample(const OrientationField& field, const VoxelBox& box);

}  // namespace bp
