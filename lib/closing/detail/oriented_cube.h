#pragma once
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "lib/closing/rotation.h"

/// A turned cube as a set of voxels: boxes around and inside it, and its rows.
namespace bp::detail {

/// Cubes along the axes of the grid that lie in, and that hold, a turned cube of any scale. Linear in the scale.
struct CubeBounds {
  bool turned = false;
  std::int64_t row_sum = 1 << kRotationBits;     ///< largest sum of a row's absolute values
  std::int64_t column_sum = 1 << kRotationBits;  ///< the same of a column

  /// Radius of the cube inside, times 16: every voxel within floor(that / 16) along each axis is in the turned cube.
  [[nodiscard]] std::int32_t inner(Scale s) const { return std::int32_t((std::int64_t(s) << kRotationBits) / row_sum); }
  /// Radius of the cube around, times 16. The columns' sums are those of the inverse, but for the rounding of the rows,
  /// which 1/512 and a voxel allow for.
  [[nodiscard]] std::int32_t outer(Scale s) const {
    if (!turned) return s;
    return std::int32_t((std::int64_t(s) * column_sum / 512 * 513 >> kRotationBits) + 1) + kScaleOne;
  }
  [[nodiscard]] std::int32_t reach(Scale s) const {
    return turned ? std::min(oriented_reach(s), outer(s) / kScaleOne) : cube_radius(s);
  }
};
[[nodiscard]] CubeBounds cube_bounds(const Rotation& canonical_rotation);

/// The cube is turned about this axis alone, and is its own slice across it from -cube_radius() to cube_radius().
[[nodiscard]] bool keeps_axis(const Rotation& r, int axis);

/// The voxels (x, dy, dz) of a turned cube around (0, 0, 0): x from `first` to `last`.
struct CubeRow {
  std::int32_t dy, first, last;
};

/// All rows of a turned cube, slice by slice, dy ascending.
class CubeRows {
 public:
  /// Cost: a few divisions for each (dy, dz) within reach. `flat`: only the rows with dy = 0 (1) or with dz = 0 (2), if
  /// it is one of these.
  CubeRows(const Rotation& rotation, Scale s, int flat = -1);

  [[nodiscard]] std::int32_t reach() const { return reach_; }
  [[nodiscard]] std::int32_t longest() const { return longest_; }  ///< voxels of the longest row
  /// Rows of slice dz, |dz| <= reach(): from begin(dz) to begin(dz + 1).
  [[nodiscard]] const CubeRow* begin(std::int32_t dz) const { return rows_.data() + slices_[std::size_t(dz + reach_)]; }

 private:
  std::int32_t reach_ = 0, longest_ = 0;
  std::vector<CubeRow> rows_;
  std::vector<std::uint32_t> slices_;
};

}  // namespace bp::detail
