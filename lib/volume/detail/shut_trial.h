#pragma once
#include <functional>

#include "lib/grid/bit_box.h"
#include "lib/volume/leak.h"

namespace bp {

/// An opening, and the voxels on both of its sides.
struct OpeningSides {
  VoxelCoord place;             ///< in the opening
  VoxelBox all;                 ///< the voxels that were searched; the outside begins at its sides
  std::int32_t most_reach = 0;  ///< most_trial_reach()
  BitBox room, outside;         ///< voxels of both sides, as far around the opening as `most_reach`
  std::int32_t least = 0;       ///< no closing at a smaller scale shuts the opening, voxels
  std::int32_t filled = 0;      ///< a closing at this scale fills the room, voxels
  /// Returns the surroundings of the opening.
  [[nodiscard]] VoxelBox around(std::int32_t reach) const { return surroundings(place, reach, all); }
  [[nodiscard]] static VoxelBox surroundings(VoxelCoord place, std::int32_t reach, const VoxelBox& all) {
    return intersect(VoxelBox{place, place + VoxelCoord{1, 1, 1}}.grown(reach), all);
  }
};

/// How far around an opening a closing is tried, in voxels, at a scale of `scale_vox`.
constexpr std::int32_t trial_reach(std::int32_t scale_vox) {
  return 2 * scale_vox + 8;
}
constexpr std::int64_t kMostTried = std::int64_t(1) << 22;  // voxels of the surroundings

/// Returns the largest reach of which the surroundings have at most kMostTried voxels. If they may be all voxels, it is
/// one at which they are.
[[nodiscard]] std::int32_t most_trial_reach(VoxelCoord place, const VoxelBox& all);

/// Tries closings with cubes, the first just above `sides.least` voxels, the last below `sides.filled` and at most just
/// above three times the least. Surroundings count: all within trial_reach() of the opening, and as much more as it
/// takes until a way over faces of empty voxels leads from the room to the outside. A closing shuts the opening if
/// there is no such way in the surroundings any more. `tried` is called before each closing, and may throw. Memory: a
/// few bits for each voxel of the surroundings, and a closing of them.
[[nodiscard]] ShutTrial try_closings(const BitBox& solid, const OpeningSides& sides,
                                     const std::function<void()>& tried);

}  // namespace bp
