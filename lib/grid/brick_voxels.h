#pragma once
#include <bit>

#include "lib/grid/brick.h"

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

}  // namespace bp
