#pragma once
#include <functional>

#include "lib/grid/stream.h"
#include "lib/grid/tile_grid.h"
#include "lib/pass/pass_progress.h"

namespace bp {

/// Tiles whose bricks lie on a shelf, and two functions that the caller knows about them.
struct ShelvedTiles {
  const TileGrid& grid;
  BrickShelf& shelf;
  std::function<void(std::uint64_t)> fill;   ///< adds the last voxels of a tile; called for many tiles at once
  std::function<bool(std::uint64_t)> holds;  ///< after fill(): false if the tile has no voxels
};

struct EmittedBricks {
  std::uint64_t solid_voxels = 0, bricks = 0, full_bricks = 0;
};

/// Fills the tiles, writes their bricks in slab order, and drops them from the shelf. The next slab is filled while one
/// is written.
EmittedBricks emit_bricks(const ShelvedTiles& tiles, int slab_axis, BrickSink& sink, const PassProgress& progress);

}  // namespace bp
