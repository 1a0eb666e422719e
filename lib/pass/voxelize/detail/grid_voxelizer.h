#pragma once
#include <atomic>
#include <memory>
#include <unordered_map>

#include "lib/pass/voxelize/detail/chunked_surface.h"
#include "lib/pass/voxelize/detail/surface_bricks.h"
#include "lib/pass/voxelize/detail/tile_fill.h"
#include "lib/pass/voxelize/detail/triangle_bins.h"
#include "lib/pass/voxelize/voxelize_options.h"

namespace bp {

/// Sets the voxels of a grid, tile by tile, and fills them. Triangles wait in bricks or bins until all have come.
class GridVoxelizer {
 public:
  /// Keeps references to the options and the chunks, which are null or used in place of bins, except for
  /// large triangles. `slack`: that voxels are grown by. Throws bad_argument if the grid is too fine.
  GridVoxelizer(const StreamHeader& header, std::int64_t slack, const VoxelizeOptions& options, ChunkedSurface* chunks);

  [[nodiscard]] std::uint64_t tiles() const { return std::uint64_t(tiles_.total()); }
  [[nodiscard]] BrickShelf& shelf() { return *shelf_; }
  [[nodiscard]] std::uint64_t scratch_bytes() const { return store_->scratch_bytes(); }

  /// Sets the voxels of the triangles that bricks take; sorts the others by tile. Thread-safe.
  [[nodiscard]] TriangleBatch sort(std::span<const TriangleD> triangles) const;
  void add(TriangleBatch&& batch);
  /// Voxelizes all triangles that were added. Sets the counts of tiles and of surface voxels.
  void voxelize(VoxelizeCounts& counts);
  /// Fills the tiles, and writes all bricks. Sets their counts.
  void fill_and_emit(BrickSink& sink, VoxelizeCounts& counts);

 private:
  [[nodiscard]] std::vector<std::uint64_t> tiles_with_triangles() const;
  [[nodiscard]] std::uint64_t waiting_bytes() const;
  void make_room();
  void voxelize_tile(std::uint64_t tile, bool last);

  const GridFrame frame_;
  const int slab_axis_;
  const std::int64_t slack_;
  const VoxelizeOptions& options_;
  ChunkedSurface* const chunks_;
  const TileGrid tiles_;
  const std::unique_ptr<BrickShelf> shelf_;
  const std::unique_ptr<Scratch> store_;
  TriangleBins bins_;                      ///< for triangles that bricks do not take
  std::unique_ptr<SurfaceBricks> bricks_;  ///< null if chunks have their own bricks, or if triangles are needed by tile
  TileWorks works_;
  std::unique_ptr<TileFill> fill_;                    ///< null: FillMode::none
  std::unordered_map<std::uint64_t, bool> on_shelf_;  ///< the tiles some of whose triangles were voxelized early
  std::atomic<std::uint64_t> surface_voxels_{0};
};

}  // namespace bp
