#pragma once
#include <algorithm>

#include "lib/grid/bit_box.h"

/// Helpers for the rows of boxes of bits.
namespace bp::detail {

[[nodiscard]] inline VoxelBox whole_words(VoxelBox box) {
  box.min.x = floor_div(box.min.x, 64) * 64;
  box.max.x = ceil_div(box.max.x, 64) * 64;
  return box;
}

/// Calls body(y, z) for the rows of `box`.
template <class Body>
void for_each_row(const VoxelBox& box, const Body& body) {
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) body(y, z);
  }
}

/// Returns bounds of the occupied voxels of `bits` inside `box`. In x they are whole words.
[[nodiscard]] inline VoxelBox occupied_bounds(const BitBox& bits, const VoxelBox& box) {
  const VoxelBox in = intersect(bits.box(), whole_words(box));
  VoxelBox found{in.max, in.min};
  for_each_row(in, [&](std::int32_t y, std::int32_t z) {
    const std::uint64_t* row = bits.row(y, z) + (in.min.x - bits.box().min.x) / 64;
    const std::int32_t words = (in.max.x - in.min.x) / 64;
    std::int32_t first = 0, last = words;
    while (first < last && row[first] == 0) ++first;
    if (first == last) return;
    while (row[last - 1] == 0) --last;
    found.min = {std::min(found.min.x, in.min.x + 64 * first), std::min(found.min.y, y), std::min(found.min.z, z)};
    found.max = {std::max(found.max.x, in.min.x + 64 * last), std::max(found.max.y, y + 1), z + 1};
  });
  return found.empty() ? VoxelBox{} : found;
}

}  // namespace bp::detail
