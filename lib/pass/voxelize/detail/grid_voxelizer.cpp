#include "lib/pass/voxelize/detail/grid_voxelizer.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/cells.h"
#include "lib/pass/voxelize/detail/emit_bricks.h"
#include "lib/voxel/voxelize.h"
#include "lib/voxel/winding.h"

namespace bp {

namespace {

constexpr std::int32_t kMaxTileVox = 512;  // Crossing has 9 bits

std::int32_t default_tile(const VoxelBox& grid) {
  const VoxelCoord s = grid.size();
  const std::int32_t longest = std::max({s.x, s.y, s.z});
  return longest <= 768 ? 128 : longest <= 8192 ? 256 : 512;  // small grids: enough tiles for the threads
}

/// Returns the bytes of a tile at work: its bits, those of its fill, the labels of its faces and runs, and a block of
/// triangles.
std::uint64_t work_bytes(std::int32_t edge_vox) {
  const auto edge = std::uint64_t(edge_vox);
  return 3 * edge * edge * edge / 8 + (std::uint64_t(4) << 20);
}

/// Returns the tiles of a grid. Throws bad_argument if it is too fine.
TileGrid cut_grid(const VoxelBox& grid, const VoxelizeOptions& options) {
  const std::int32_t edge = options.tile_vox > 0 ? options.tile_vox : default_tile(grid);
  if (edge % kBrickEdge != 0 || edge > kMaxTileVox)
    fail(ErrorCode::bad_argument, "a tile of {} voxels a side is no multiple of 64 up to {}", edge, kMaxTileVox);
  const TileGrid tiles(grid, edge);
  const VoxelCoord size = grid.size();
  if (tiles.total() > TileGrid::kMostTiles) {
    fail(ErrorCode::bad_argument, {Remedy::coarser_grid}, "a grid of {} x {} x {} voxels is too fine", size.x, size.y,
         size.z);
  }
  if (options.fill == FillMode::winding && std::max({size.x, size.y, size.z}) > kWindingVoxels)
    fail(ErrorCode::bad_argument, {Remedy::flood_fill},
         "a grid over 2^24 voxels a side cannot be filled by winding numbers");
  return tiles;
}

/// Returns buffers for the tiles at work.
TileWorks make_works(std::int32_t edge_vox, std::uint64_t memory_bytes) {
  const std::uint64_t fit = std::max<std::uint64_t>(1, memory_bytes / work_bytes(edge_vox));
  std::vector<std::unique_ptr<TileWork>> works(std::min<std::uint64_t>(fit, std::uint64_t(thread_count())));
  for (auto& w : works) w = std::make_unique<TileWork>();
  return TileWorks(std::move(works));
}

}  // namespace

GridVoxelizer::GridVoxelizer(const StreamHeader& header, std::int64_t slack, const VoxelizeOptions& options,
                             ChunkedSurface* chunks)
    : frame_(header.frame),
      slab_axis_(header.slab_axis),
      slack_(slack),
      options_(options),
      chunks_(chunks),
      tiles_(cut_grid(voxels_of(header.bricks), options)),
      shelf_(options.context.make_shelf()),
      store_(options.context.make_scratch()),
      bins_(tiles_, *store_),
      works_(make_works(tiles_.edge_vox, options.tile_memory_bytes)) {
  if (chunks_ == nullptr && options.fill != FillMode::winding)
    bricks_ = std::make_unique<SurfaceBricks>(options.context.memory.bytes / 10 * 3);
  if (options.fill != FillMode::none)
    fill_ = std::make_unique<TileFill>(options.fill, tiles_, *shelf_, *store_, works_);
}

TriangleBatch GridVoxelizer::sort(std::span<const TriangleD> triangles) const {
  std::vector<FixedTriangle> rest;
  if (bricks_) {
    bricks_->add(triangles, frame_, slack_, rest);
  } else {
    const FixedFrame to_fixed(frame_);
    rest.reserve(triangles.size());
    for (const TriangleD& t : triangles) rest.push_back(to_fixed(t));
  }
  return bins_.sort(rest, slack_);
}

void GridVoxelizer::add(TriangleBatch&& batch) {
  bins_.add(std::move(batch));
  if (waiting_bytes() > options_.context.memory.bytes) make_room();
}

/// Returns the bytes that count against memory_bytes. The store and the shelf count at most as half of it: with more,
/// the bins would have nothing to grow in.
std::uint64_t GridVoxelizer::waiting_bytes() const {
  const std::uint64_t aside = store_->memory_bytes() + shelf_->memory_bytes() + bins_.table_bytes();
  return bins_.memory_bytes() + (bricks_ ? bricks_->memory_bytes() : 0) +
         std::min(aside, options_.context.memory.bytes / 2);
}

/// Voxelizes tiles with many triangles now, since their bits are far smaller. The triangles of the other tiles go to
/// the store; all do while chunks still add to their bricks.
void GridVoxelizer::make_room() {
  const std::uint64_t tile_bytes =
      std::uint64_t(tiles_.edge_vox) * std::uint64_t(tiles_.edge_vox) * std::uint64_t(tiles_.edge_vox) / 8;
  std::vector<std::uint64_t> many, few;
  for (const std::uint64_t tile : bins_.tiles()) {
    const std::uint64_t bytes = bins_.memory_bytes(tile);
    if (bytes > 4 * tile_bytes && !chunks_) {
      many.push_back(tile);
    } else if (bytes > 0) {
      few.push_back(tile);
    }
  }
  for (const std::uint64_t tile : many) on_shelf_[tile];  // no insertion while threads look up
  parallel_for(std::int64_t(many.size()), [&](std::int64_t i) {
    const std::uint64_t tile = many[std::size_t(i)];
    voxelize_tile(tile, false);
    bins_.release(tile);
  });
  bins_.spill(few);
}

std::vector<std::uint64_t> GridVoxelizer::tiles_with_triangles() const {
  std::vector<std::uint64_t> tiles = bins_.tiles();
  std::vector<BrickCoord> bricks;
  if (bricks_) bricks = bricks_->coords();
  if (chunks_) bricks = chunks_->bricks().coords();
  for (const BrickCoord brick : bricks) {
    const VoxelCoord from = first_voxel(brick) - tiles_.voxels.min;
    tiles.push_back(tiles_.index({from.x / tiles_.edge_vox, from.y / tiles_.edge_vox, from.z / tiles_.edge_vox}));
  }
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  return tiles;
}

void GridVoxelizer::voxelize(VoxelizeCounts& counts) {
  const std::vector<std::uint64_t> tiles = tiles_with_triangles();
  for (const std::uint64_t tile : tiles) on_shelf_[tile];
  counts.tiles_touched = tiles.size();
  PassSteps steps(options_.context.progress, "voxelizing", "tiles", tiles.size());
  parallel_for(std::int64_t(tiles.size()), [&](std::int64_t i) {
    const std::uint64_t tile = tiles[std::size_t(i)];
    voxelize_tile(tile, true);
    bins_.release(tile);
    steps.add(1);
  });
  if (fill_) fill_->resolve();
  counts.surface_voxels = surface_voxels_;
}

/// Adds the tile's waiting triangles to its voxels. `last`: the tile gets no more triangles.
void GridVoxelizer::voxelize_tile(std::uint64_t tile, bool last) {
  const TileWorks::Lease work(works_);
  const VoxelBox box = tiles_.box(tiles_.coord(tile));
  work->bits.reset(box);
  bool& on_shelf = on_shelf_.at(tile);
  if (on_shelf) load_voxels(*shelf_, work->bits);
  on_shelf = true;
  if (chunks_) chunks_->bricks().take(work->bits);
  if (bricks_ && last) bricks_->take(work->bits);
  bins_.for_each(tile, [&](std::span<const FixedTriangle> triangles) {
    work->crossings.clear();
    voxelize_surface(triangles, work->bits, slack_);
    if (options_.fill == FillMode::winding) find_crossings(triangles, box, work->crossings);
    if (fill_) fill_->add_crossings(tile, work->crossings);
  });
  store_voxels(work->bits, *shelf_);
  if (!last) return;
  surface_voxels_ += work->bits.count();
  if (fill_) fill_->add_surface(tile, work->bits);
}

void GridVoxelizer::fill_and_emit(BrickSink& sink, VoxelizeCounts& counts) {
  const PassProgress& progress = options_.context.progress;
  if (options_.fill == FillMode::winding) {
    fill_->fill_columns(progress);
    counts.open_columns = fill_->open_columns();
  }
  const bool flood = options_.fill == FillMode::flood || options_.fill == FillMode::inside;
  const ShelvedTiles tiles{
      tiles_, *shelf_,
      [&](std::uint64_t tile) {
        if (flood) fill_->fill_flood(tile);
      },
      [&](std::uint64_t tile) { return on_shelf_.contains(tile) || (fill_ && fill_->has_filled(tile)); }};
  const EmittedBricks emitted = emit_bricks(tiles, slab_axis_, sink, progress);
  counts.solid_voxels = emitted.solid_voxels;
  counts.bricks = emitted.bricks;
  counts.full_bricks = emitted.full_bricks;
}

}  // namespace bp
