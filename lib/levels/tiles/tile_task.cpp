#include "lib/levels/tiles/tile_task.h"

#include <algorithm>
#include <cmath>

namespace bp {

TileParams tile_params(const TilesetPlan& plan, std::size_t level, const CutOptions& options) {
  const CutLevel& cut = plan.cut[level];
  TileParams params = options.tile;
  params.scale_world = cut.scale_world;
  params.faces = cut.target.faces;
  // The enclosed voxels reach up to a voxel's diagonal beyond the scene.
  if (const double asked = cut.target.error_world; asked > 0)
    params.error_world = std::max(asked - std::sqrt(3.0) * (cut.frame.voxel + plan.cut.front().frame.voxel), asked / 4);
  if (options.jobs) params.wanted = WantedTiles{cut, *options.jobs};
  return params;
}

std::int32_t tile_reach(double scale_world, double voxel) {
  return 1 + std::max(std::int32_t(std::ceil(scale_world / voxel)) + 2, 4);
}

LatticeCoord tile_origin(const Cells& cells, CellCoord cell) {
  const VoxelCoord first = cells.box(cell).min;
  const std::int64_t half = cells.edge_vox / 2;
  return {(first.x + half) * kLatticePerVoxel, (first.y + half) * kLatticePerVoxel,
          (first.z + half) * kLatticePerVoxel};
}

}  // namespace bp
