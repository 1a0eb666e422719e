#pragma once
#include <cstddef>

#include "lib/core/memory_share.h"
#include "lib/device/backend.h"
#include "lib/grid/tile_grid.h"

namespace bp {

/// The tiles of a closing, and the resources for their work.
struct TilePlan {
  TileGrid tiles;
  std::size_t at_work = 0;     ///< tiles that fit in memory at once, and find a worker
  std::size_t cube_bytes = 0;  ///< ClosingParams::cube_bytes, if cubes are turned
};

/// Chooses the tiles of a grid: those of `tile_vox` a side, or, if it is 0, of the size with the best product: of the
/// workers that fit in memory and find enough tiles, and of the share of the voxels they read that are not halo.
/// `widest`: the halo where the scale is largest. `mostly_stays`: EarlierTiles::mostly_stays(). Throws as
/// close_stream().
[[nodiscard]] TilePlan plan_tiles(const VoxelBox& grid, const Halo& widest, bool turned, bool mostly_stays,
                                  std::size_t backends, std::int32_t tile_vox, const MemoryShare& memory);

}  // namespace bp
