#pragma once
#include "lib/grid/stream.h"
#include "lib/store/result_key.h"

/// Functions for the part of a solid in a box.
namespace bp {

/// Calls f(brick) for each brick that holds a voxel of `box`.
template <class F>
void for_each_brick(const VoxelBox& box, const F& f) {
  for_each(bricks_of(box), f);
}

/// Returns the voxels of row (y, z) of a brick that lie in `box`, as a word.
[[nodiscard]] std::uint64_t row_within(BrickCoord brick, std::int32_t y, std::int32_t z, const VoxelBox& box);

/// Gets the voxels of a brick that lie in `box`. It fills `out` in each case.
BrickFill get_within(const BrickShelf& shelf, BrickCoord brick, const VoxelBox& box, BrickBits& out);

/// Returns the voxels of `from` that lie in `box`, on a new shelf.
[[nodiscard]] std::unique_ptr<BrickShelf> clipped(const BrickShelf& from, const VoxelBox& box,
                                                  const ShelfFactory& make_shelf);

/// Returns true if every voxel of `box` is occupied.
[[nodiscard]] bool is_full(const BrickShelf& shelf, const VoxelBox& box);

/// Adds the voxels in `box`, and their place relative to `origin`, to a hash.
void add_voxels(KeyHash& hash, const BrickShelf& shelf, const VoxelBox& box, BrickCoord origin);

}  // namespace bp
