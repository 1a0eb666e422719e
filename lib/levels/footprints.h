#pragma once
#include <vector>

#include "lib/grid/stream.h"

namespace bp {

/// A part of a scene that stands apart from others, as seen from above.
struct Footprint {
  VoxelBox box;               ///< bounds of its voxels
  std::uint64_t columns = 0;  ///< columns of voxels along the axis up that hold one of its voxels
  std::uint64_t hidden = 0;   ///< hidden voxels in these columns
};

/// Returns the parts whose columns are connected, over sides and corners, in the order of their first columns. `up`:
/// the axis. Memory: 4 bytes for each column of the bricks. Cost: two passes over the touched voxels, one over the
/// hidden ones.
[[nodiscard]] std::vector<Footprint> footprints(const BrickShelf& touched, const BrickShelf& hidden, int up);

}  // namespace bp
