#pragma once
#include "lib/grid/stream.h"
#include "lib/store/result_key.h"

/// Part of a solid.
namespace bp {

/// f(brick) for each brick that holds a voxel of `box`.
template <class F>
void for_each_brick(const VoxelBox& box, const F& f) {
  for_each(bricks_of(box), f);
}

/// Voxels of row (y, z) of a brick that lie in `box`, as a word.
[[nodiscard]] std::uint64_t row_within(BrickCoord brick, std::int32_t y, std::int32_t z, const VoxelBox& box);

/// The voxels of a brick that lie in `box`; fills `out` in each case.
BrickFill get_within(const BrickShelf& shelf, BrickCoord brick, const VoxelBox& box, BrickBits& out);

/// The voxels of `from` that lie in `box`, on a shelf of their own.
[[nodiscard]] std::unique_ptr<BrickShelf> clipped(const BrickShelf& from, const VoxelBox& box,
                                                  const ShelfFactory& make_shelf);

/// True if every voxel of `box` is occupied.
[[nodiscard]] bool is_full(const BrickShelf& shelf, const VoxelBox& box);

/// Adds the voxels in `box`, and where they lie relative to `origin`.
void add_voxels(KeyHash& hash, const BrickShelf& shelf, const VoxelBox& box, BrickCoord origin);

}  // namespace bp
