#pragma once
#include <vector>

#include "lib/grid/stream.h"

namespace bp::detail {

/// Returns the corners of the brick's voxels that a proxy may rest on: all convex corners, and samples of straight
/// edges and flat sides, without which nothing would tell a large face beside them where it rests. Corners at the
/// brick's high sides belong to the next bricks.
[[nodiscard]] std::vector<VoxelCoord> resting_points_of(const BrickShelf& shelf, BrickCoord coord);

}  // namespace bp::detail
