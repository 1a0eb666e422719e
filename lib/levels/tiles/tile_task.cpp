#include "lib/levels/tiles/tile_task.h"

#include <algorithm>
#include <cmath>

namespace bp {

std::int32_t tile_reach(double scale_world, double voxel) {
  return 1 + std::max(std::int32_t(std::ceil(scale_world / voxel)) + 2, 4);
}

}  // namespace bp
