#include "tests/reference/flood.h"

#include <vector>

namespace bp::reference {

BitBox fill_enclosed(const BitBox& solid, const VoxelBox& grid) {
  const VoxelBox around = grid.grown(1);
  BitBox reached(around);
  std::vector<VoxelCoord> queue{around.min};
  reached.set(around.min);
  while (!queue.empty()) {
    const VoxelCoord p = queue.back();
    queue.pop_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (int step = -1; step <= 1; step += 2) {
        VoxelCoord q = p;
        q[axis] += step;
        if (!around.contains(q) || (grid.contains(q) && solid.test(q)) || reached.test(q)) continue;
        reached.set(q);
        queue.push_back(q);
      }
    }
  }
  BitBox filled = solid;
  for (std::int32_t z = grid.min.z; z < grid.max.z; ++z)
    for (std::int32_t y = grid.min.y; y < grid.max.y; ++y)
      for (std::int32_t x = grid.min.x; x < grid.max.x; ++x)
        if (!reached.test({x, y, z})) filled.set({x, y, z});
  return filled;
}

}  // namespace bp::reference
