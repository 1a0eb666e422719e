#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/coords.h"
#include "lib/core/host_device.h"
#include "lib/grid/orientation_field.h"
#include "lib/grid/scale_field.h"

/// Cubes with an orientation of their own at each voxel, as the structuring element of a dilation ([CB17] §3.3). They
/// are decided in integers, like everything else.
namespace bp {

/// Returns true if the cube of scale `s` around a voxel holds the voxel at the offset (x, y, z): |row . (x, y, z)| <= s
/// for each row.
[[nodiscard]] BP_HD inline bool in_oriented_cube(const Rotation& r, Scale s, std::int32_t x, std::int32_t y,
                                                 std::int32_t z) {
  for (const auto& row : r.row) {
    const std::int64_t along = std::int64_t(row[0]) * x + std::int64_t(row[1]) * y + std::int64_t(row[2]) * z;
    const std::int64_t limit = std::int64_t(s) * ((1 << kRotationBits) / kScaleOne);
    if (along > limit || along < -limit) return false;
  }
  return true;
}

/// Returns how far such a cube of any rotation reaches along an axis, at most: less than sqrt(3) S + 1, for rows of
/// length 1 - 2^-12 or more.
[[nodiscard]] BP_HD constexpr std::int32_t oriented_reach(Scale s) {
  return std::int32_t(s) * 1775 / 1024 / kScaleOne + 1;
}

/// The largest upright cube in a turned cube, and the smallest one around it, for any scale. Both are linear in the
/// scale.
struct CubeBounds {
  bool turned = false;
  std::int64_t row_sum = 1 << kRotationBits;     ///< largest sum of a row's absolute values
  std::int64_t column_sum = 1 << kRotationBits;  ///< the same for columns

  /// Returns the radius of the cube inside, times 16: every voxel within floor(that / 16) along each axis is in the
  /// turned cube.
  [[nodiscard]] std::int32_t inner(Scale s) const { return std::int32_t((std::int64_t(s) << kRotationBits) / row_sum); }
  /// Returns the radius of an upright cube around the turned cube, times 16, rounded up. The least one follows from the
  /// row sums of the inverse rotation. These would be the column sums here, if the rows were exact. A factor of 513/512
  /// and one more voxel make up for the rounding of the rows.
  [[nodiscard]] BP_HD std::int32_t outer(Scale s) const {
    if (!turned) return s;
    return std::int32_t((std::int64_t(s) * column_sum / 512 * 513 >> kRotationBits) + 1) + kScaleOne;
  }
  [[nodiscard]] BP_HD std::int32_t reach(Scale s) const {
    if (!turned) return cube_radius(s);
    const std::int32_t most = oriented_reach(s), own = outer(s) / kScaleOne;
    return own < most ? own : most;
  }
};
[[nodiscard]] BP_HD inline CubeBounds cube_bounds(const Rotation& canonical_rotation) {
  CubeBounds b;
  for (int i = 0; i < 3; ++i) {
    std::int64_t row = 0, column = 0;
    for (int j = 0; j < 3; ++j) {
      const int along = canonical_rotation.row[i][j], down = canonical_rotation.row[j][i];
      row += along < 0 ? -along : along;
      column += down < 0 ? -down : down;
      b.turned = b.turned || along != (i == j ? 1 << kRotationBits : 0);
    }
    if (row > b.row_sum) b.row_sum = row;
    if (column > b.column_sum) b.column_sum = column;
  }
  return b;
}

/// Scales at which large voxels, of edge^3 voxels each, decide about small ones. Take two large voxels, D apart. If
/// |row . D| is within `sure` for each row, then all their voxels are in the turned cube of scale `s` of each other. If
/// it is beyond `possible` for some row, none is. In 1/16 of the large voxels. `sure` may be negative: then no two are
/// surely in.
struct CoarseScale {
  std::int32_t sure, possible;
};
[[nodiscard]] BP_HD inline CoarseScale coarse_scale(std::int64_t row_sum, Scale s, std::int32_t edge) {
  const std::int32_t one = (1 << kRotationBits) / kScaleOne, unit = one * edge;
  const std::int32_t limit = s * one, between = (edge - 1) * std::int32_t(row_sum);
  return {floor_div(limit - between, unit), ceil_div(limit + between, unit)};
}

/// The cubes of an orientation field over a region.
struct CubesOver {
  std::int32_t edge = 0;             ///< of a cell of the field, voxels
  OrientationCell origin, size;      ///< cells of the field in the region
  std::vector<std::uint16_t> cells;  ///< index into `rotations`, x fastest
  std::vector<Rotation> rotations;   ///< canonical
  CubeBounds widest;                 ///< bounds over all rotations

  /// Returns the index into `rotations` at a voxel of the region.
  [[nodiscard]] std::uint16_t at(VoxelCoord p) const;
};
[[nodiscard]] CubesOver cubes_over(const OrientationField& field, const VoxelBox& region);

/// Returns the reach of all cubes of a field: at most oriented_reach(), and cube_radius() if none is turned.
[[nodiscard]] std::int32_t oriented_reach(const OrientationField& field, Scale s);

/// One rotation for each cell of 8^3 voxels. The cells are those of ScaleLattice.
struct RotationLattice {
  VoxelCoord origin, size;  ///< in cells; x fastest
  std::vector<Rotation> cells;

  [[nodiscard]] const Rotation& at(VoxelCoord p) const {
    const std::int32_t x = floor_div(p.x, kScaleStep) - origin.x, y = floor_div(p.y, kScaleStep) - origin.y,
                       z = floor_div(p.z, kScaleStep) - origin.z;
    return cells[(std::size_t(z) * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x) + std::size_t(x)];
  }
};

/// Returns the rotations of all voxels of a box.
[[nodiscard]] RotationLattice sample(const OrientationField& field, const VoxelBox& box);

}  // namespace bp
