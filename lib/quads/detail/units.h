#pragma once
#include <optional>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/quads/detail/cells.h"

namespace bp {

/// Units along the longest side of the voxels.
constexpr std::int32_t kUnitsAlong = 128;

/// A grid of units: cubes of some voxels, counted from `origin`.
struct Units {
  VoxelCoord origin;      ///< in voxels
  std::int32_t edge = 1;  ///< of a unit, in voxels
  VoxelBox box;           ///< in units
  Grid solid;             ///< the units that hold a voxel

  [[nodiscard]] VoxelCoord unit(VoxelCoord p) const {
    for (int i = 0; i < 3; ++i) p[i] = floor_div(p[i] - origin[i], edge);
    return p;
  }
};

/// Returns the units of all voxels. A mirror plane lies between units. `rim`: empty units around the others, besides
/// the one that each grid has.
[[nodiscard]] Units units_of(const BrickShelf& voxels, const std::optional<MirrorPlane>& plane, std::int32_t rim = 0);

}  // namespace bp
