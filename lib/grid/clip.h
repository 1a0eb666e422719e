#pragma once
#include "lib/grid/stream.h"

/// Part of a solid.
namespace bp {

/// The voxels of `from` that lie in `box`, on a shelf of their own.
[[nodiscard]] std::unique_ptr<BrickShelf> clipped(const BrickShelf& from, const VoxelBox& box,
                                                  const ShelfFactory& make_shelf);

/// True if every voxel of `box` is occupied.
[[nodiscard]] bool is_full(const BrickShelf& shelf, const VoxelBox& box);

/// f(brick) for each brick that holds a voxel of `box`.
template <class F>
void for_each_brick(const VoxelBox& box, const F& f) {
  const BrickBox bricks = bricks_of(box);
  for (BrickCoord c = bricks.min; c.z < bricks.max.z; ++c.z) {
    for (c.y = bricks.min.y; c.y < bricks.max.y; ++c.y) {
      for (c.x = bricks.min.x; c.x < bricks.max.x; ++c.x) f(c);
    }
  }
}

/// Voxels of row (y, z) of a brick that lie in `box`, as a word.
[[nodiscard]] std::uint64_t row_within(BrickCoord brick, std::int32_t y, std::int32_t z, const VoxelBox& box);

}  // namespace bp
