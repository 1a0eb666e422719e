#pragma once
#include <bit>

#include "lib/grid/bit_box.h"
#include "lib/grid/brick.h"
#include "lib/grid/stream.h"

namespace bp {

/// Calls visit(p) for each occupied voxel of the brick at `coord`, in the order of memory: x is the fastest.
template <class Visit>
void for_each_voxel(const BrickBits& bits, BrickCoord coord, const Visit& visit) {
  const VoxelCoord first = first_voxel(coord);
  for (std::int32_t i = 0; i < std::int32_t(bits.size()); ++i) {
    for (std::uint64_t w = bits[std::size_t(i)]; w != 0; w &= w - 1)
      visit(VoxelCoord{first.x + std::countr_zero(w), first.y + i % kBrickEdge, first.z + i / kBrickEdge});
  }
}

/// Does the same for each occupied voxel of a box.
template <class Visit>
void for_each_voxel(const BitBox& voxels, const Visit& visit) {
  const VoxelBox& box = voxels.box();
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      const std::uint64_t* const row = voxels.row(y, z);
      for (std::int32_t i = 0; i < voxels.words_per_row(); ++i) {
        for (std::uint64_t w = row[i]; w != 0; w &= w - 1)
          visit(VoxelCoord{box.min.x + 64 * i + std::countr_zero(w), y, z});
      }
    }
  }
}

/// Does the same for each occupied voxel of a shelf, in the order of its bricks.
template <class Visit>
void for_each_voxel(const BrickShelf& shelf, const Visit& visit) {
  BrickBits bits;
  for (const BrickCoord& coord : shelf.coords()) {
    (void)shelf.get(coord, bits);
    for_each_voxel(bits, coord, visit);
  }
}

/// Returns the box around all occupied voxels of a box or a shelf; empty if there is none.
template <class Voxels>
[[nodiscard]] VoxelBox bounds_of_voxels(const Voxels& voxels) {
  VoxelBox bounds;
  for_each_voxel(voxels, [&](VoxelCoord p) { bounds = hull(bounds, VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}}); });
  return bounds;
}

}  // namespace bp
