#pragma once
#include <functional>

#include "lib/grid/bit_box.h"

namespace bp {

/// The surroundings of an opening. Voxels beyond the box of `solid` are empty.
struct OpeningSides {
  const BitBox& solid;
  VoxelCoord place;                               ///< in the opening
  std::function<bool(VoxelCoord)> room, outside;  ///< voxels of both sides
};

/// How far around an opening a closing is tried, in voxels, at a scale of `scale_vox`.
constexpr std::int32_t trial_reach(std::int32_t scale_vox) {
  return 2 * scale_vox + 8;
}

/// Tries closings with cubes, the first just above `least` voxels, the last just above three times as many. Returns the
/// first scale, in whole voxels, after which no way over faces of empty voxels within trial_reach() of the opening
/// leads from the room to the outside. Returns 0 if none does, or if the surroundings are larger than kMostTried.
[[nodiscard]] std::int32_t least_shutting_scale(const OpeningSides& sides, std::int32_t least);
constexpr std::int64_t kMostTried = std::int64_t(1) << 22;  // voxels

}  // namespace bp
