#pragma once
#include <vector>

#include "lib/closing/rotation.h"

/// A turned cube as a set of voxels: its rows.
namespace bp::detail {

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
