#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>

#include "lib/core/pool.h"
#include "lib/grid/stream.h"
#include "lib/grid/tile_grid.h"
#include "lib/pass/pass_progress.h"
#include "lib/store/scratch.h"
#include "lib/volume/outside.h"
#include "lib/voxel/winding.h"

/// Fills the inside of the surface voxels of a grid of tiles, on their shelf.
namespace bp {

/// Buffers for a tile at work.
struct TileWork {
  BitBox bits;
  std::vector<Crossing> crossings;
};
using TileWorks = Pool<std::unique_ptr<TileWork>>;

/// Usage: call add_crossings() and add_surface() for each tile as it is voxelized, then resolve(); then for winding
/// fill_columns(), else fill_flood() for each tile. Thread-safe, except for resolve().
class TileFill {
 public:
  /// Keeps references to all arguments but `tiles`. The tiles' surface voxels are on the shelf; crossings go to the
  /// store.
  TileFill(FillMode mode, const TileGrid& tiles, BrickShelf& shelf, Scratch& store, TileWorks& works);

  /// For winding: adds some of the crossings of a tile. Thread-safe for different tiles.
  void add_crossings(std::uint64_t tile, std::span<const Crossing> crossings);
  /// Says that the tile's surface voxels are complete. Tiles without any need not be announced.
  void add_surface(std::uint64_t tile, const BitBox& bits);
  void resolve();

  /// For FillMode::flood and inside: fills a tile. With inside, its surface voxels are removed.
  void fill_flood(std::uint64_t tile);
  /// For winding: fills all tiles.
  void fill_columns(const PassProgress& progress);
  /// Returns whether the tile has been given voxels so far, whether it had some before or not.
  [[nodiscard]] bool has_filled(std::uint64_t tile) const;
  /// Returns the number of columns whose crossings do not cancel. There the flood decided.
  [[nodiscard]] std::uint64_t open_columns() const { return open_columns_; }

 private:
  /// The open columns of voxels in one column of tiles: bits in the layout of a slice.
  struct OpenColumns {
    std::vector<std::uint64_t> bits;
    std::uint64_t count = 0;
  };
  void fill_column(std::int32_t tx, std::int32_t ty);
  [[nodiscard]] OpenColumns open_columns(std::int32_t tx, std::int32_t ty, TileWork& work) const;
  void get_crossings(std::uint64_t tile, std::vector<Crossing>& out) const;
  void store(std::uint64_t tile, const BitBox& bits);
  [[nodiscard]] VoxelBox box(std::uint64_t tile) const { return tiles_.box(tiles_.coord(tile)); }

  const FillMode mode_;
  const TileGrid tiles_;
  BrickShelf& shelf_;
  Scratch& store_;
  TileWorks& works_;
  OutsideFlood flood_;
  std::unordered_map<std::uint64_t, std::vector<Scratch::Handle>> crossings_;  // by tile
  std::unordered_set<std::uint64_t> with_surface_;                             // FillMode::inside: tiles
  std::unordered_set<std::uint64_t> filled_;                                   // tiles
  mutable std::mutex mutex_;
  std::atomic<std::uint64_t> open_columns_{0};
};

}  // namespace bp
