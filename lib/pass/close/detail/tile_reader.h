#pragma once
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "lib/device/backend.h"
#include "lib/grid/stream.h"
#include "lib/grid/tile_grid.h"

namespace bp {

/// Puts the solid bricks of a stream onto a shelf, and lists the tiles that have one in reach, slab by slab. A slab is
/// one step of tiles across the slab axis.
class TileReader {
 public:
  using SlabTiles = std::set<TileCoord>;

  /// Keeps references to the source, the shelf and the tiles. `widest`: the halo where the scale is largest.
  TileReader(BrickSource& source, BrickShelf& solid, const TileGrid& tiles, const Halo& widest);

  /// Returns the next tile, once all bricks that any tile of its slab can see have been taken; false at the end.
  [[nodiscard]] bool next(TileCoord& tile);
  void read_rest();  ///< to the end record
  /// Removes the first slab if it lies before `current`, and no tile from there on can see it, and returns its tiles.
  /// Thread-safe.
  [[nodiscard]] std::optional<SlabTiles> take_before(std::int32_t current);
  /// Removes all slabs, and returns them.
  [[nodiscard]] std::vector<std::pair<std::int32_t, SlabTiles>> take_all();

  std::uint64_t ignored_bricks = 0;  ///< as in CloseCounts
  std::atomic<double> seconds{0};

 private:
  void read_before(std::int64_t end_vox);
  void list_tiles(const Brick& brick);
  /// Returns the first voxel across the slab axis that is no longer in the slab.
  [[nodiscard]] std::int64_t end_of(std::int32_t slab) const {
    return tiles_.voxels.min[axis_] + (std::int64_t(slab) + 1) * tiles_.edge_vox;
  }

  BrickSource& source_;
  BrickShelf& solid_;
  const TileGrid& tiles_;
  const Halo widest_;
  const int axis_;
  Brick next_brick_;  ///< read from the source, and not yet taken
  bool more_ = true;
  std::vector<TileCoord> queue_;  ///< tiles of the slab that is given out now, last first
  std::int32_t next_slab_ = 0;
  std::mutex mutex_;
  std::map<std::int32_t, SlabTiles> slabs_;  ///< slabs that are not removed yet
};

}  // namespace bp
