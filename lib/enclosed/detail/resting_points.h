#pragma once
#include <vector>

#include "lib/grid/stream.h"

namespace bp::detail {

/// Corners of voxels that a proxy may rest on, those at the low sides of a brick's voxels: all convex ones; of straight
/// edges and flat sides samples, without which nothing would tell a large face beside them where it rests.
[[nodiscard]] std::vector<VoxelCoord> resting_points_of(const BrickShelf& shelf, BrickCoord coord);

}  // namespace bp::detail
