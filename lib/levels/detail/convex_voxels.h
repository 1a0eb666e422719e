#pragma once
#include "lib/grid/stream.h"

namespace bp {

[[nodiscard]] std::uint64_t count_voxels(const BrickShelf& solid);

/// How many voxels the convex hull of a solid holds besides those of the solid, about: none if the solid is convex.
/// The hull is that of the voxels' middles, so a convex solid gives a number below 0. 40 bytes for each run of boundary
/// voxels, for a moment.
[[nodiscard]] double voxels_beside_hull(const BrickShelf& solid);

}  // namespace bp
