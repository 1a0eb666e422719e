#include "lib/pass/voxelize/voxelize_pass.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <unordered_map>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/grid/cells.h"
#include "lib/pass/voxelize/detail/chunked_surface.h"
#include "lib/pass/voxelize/detail/emit_bricks.h"
#include "lib/pass/voxelize/detail/scene_passes.h"
#include "lib/pass/voxelize/detail/surface_bricks.h"
#include "lib/pass/voxelize/detail/tile_fill.h"
#include "lib/pass/voxelize/detail/triangle_bins.h"
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

/// The work of voxelize_stream() for one scene.
class SceneVoxelizer {
 public:
  SceneVoxelizer(TriangleSource& source, Backends& backends, const VoxelizeOptions& options)
      : source_(source),
        options_(options),
        chunks_(options.context.results != nullptr && options.fill != FillMode::winding
                    ? std::make_unique<ChunkedSurface>(*options.context.results, options.context.turn)
                    : nullptr),
        // Three fifths for triangles: their bins, which are half as large, then fit in the rest.
        scene_(source, options.context.memory.bytes / 5 * 3, chunks_.get()) {
    for (int i = 0; backends.empty() && i < thread_count(); ++i) own_.push_back(std::make_unique<CpuBackend>());
    std::vector<Backend*> all;
    for (const auto& backend : backends.empty() ? own_ : backends) all.push_back(backend.get());
    backends_ = std::make_unique<BackendPool>(std::move(all));
  }

  VoxelizeCounts operator()(const OpenSink& open) {
    const bool guessed = guess_grid();
    measure(guessed);
    lay_grid(guessed);
    BrickSink& sink = open(header_, counts_);
    if (!sorted_) sort_triangles();
    scene_.release();
    voxelize();
    fill_and_emit(sink);
    counts_.scratch_bytes = store_->scratch_bytes();
    return counts_;
  }

 private:
  [[nodiscard]] bool guess_grid();
  void measure(bool guessed);
  void lay_grid(bool guessed);
  [[nodiscard]] StreamHeader header_of(const Bounds3d& bounds, double off);
  void cut_grid();
  using Portion = ScenePasses::Portion;
  using NextPortion = ScenePasses::NextPortion;
  void sort_triangles();
  void bin(const NextPortion& next);
  void bin(TriangleBatch&& batch);
  [[nodiscard]] TriangleBatch sort(std::span<const TriangleD> triangles) const;
  void look_up_chunks();
  [[nodiscard]] std::vector<std::uint64_t> tiles_with_triangles() const;
  [[nodiscard]] std::uint64_t waiting_bytes() const;
  void make_room();
  void voxelize();
  void voxelize_tile(std::uint64_t tile, bool& on_shelf, bool last);
  void fill_and_emit(BrickSink& sink);
  [[nodiscard]] VoxelBox tile_box(std::uint64_t tile) const { return tiles_.box(tiles_.coord(tile)); }

  TriangleSource& source_;
  const VoxelizeOptions& options_;
  Backends own_;  ///< if the caller gave none
  std::unique_ptr<BackendPool> backends_;
  std::unique_ptr<TileWorks> works_;
  std::unique_ptr<BrickShelf> shelf_;
  std::unique_ptr<Scratch> store_;
  VoxelizeCounts counts_;

  std::unique_ptr<ChunkedSurface> chunks_;  ///< used in place of bins_, except for large triangles
  ScenePasses scene_;
  StreamHeader header_;
  std::int64_t slack_ = kFixedSlack;  ///< that voxels are grown by; a grid that is guessed does not know it
  TileGrid tiles_;
  std::unique_ptr<SurfaceBricks> bricks_;  ///< null if chunks have their own bricks, or if triangles are needed by tile
  std::unique_ptr<TriangleBins> bins_;     ///< for triangles that bricks do not take
  bool sorted_ = false;                    ///< all triangles are in bricks_ and bins_
  std::unordered_map<std::uint64_t, bool> on_shelf_;  ///< the tiles some of whose triangles were voxelized early
  std::unique_ptr<TileFill> fill_;                    ///< null: FillMode::none
  std::atomic<std::uint64_t> surface_voxels_{0};
};

/// Makes a grid for the bounds that the source tells beforehand. If they turn out to be right, the scene is read once.
bool SceneVoxelizer::guess_grid() {
  if (!options_.voxel_by_bounds || chunks_) return false;
  const std::optional<Bounds3d> bounds = source_.bounds();
  if (!bounds) return false;
  try {
    header_ = header_of(*bounds, 0);
    cut_grid();
  } catch (const Error&) {  // the error is reported when the bounds are known
    return false;
  }
  return true;
}

void SceneVoxelizer::measure(bool guessed) {
  std::optional<ScenePasses::Sorter> sorter;
  if (guessed) {
    sorter = {header_.bounds, [&](std::span<const TriangleD> triangles) { return sort(triangles); },
              [&](TriangleBatch&& batch) { bin(std::move(batch)); }};
  }
  scene_.measure(options_.context.progress, sorter);
  counts_.scene = source_.counts();
  counts_.area = scene_.sums().area();
  counts_.extent = scene_.sums().extent();
  counts_.stray = scene_.sums().stray();
  counts_.signed_volume = scene_.sums().volume();
  counts_.input_hash = scene_.input_hash();
}

/// `off`: what points may be off by, scene units.
StreamHeader SceneVoxelizer::header_of(const Bounds3d& bounds, double off) {
  counts_.voxel_asked = options_.voxel_size(bounds);
  const UpAxis up = options_.up ? *options_.up : source_.up().value_or(UpAxis::y);
  return solid_header(bounds, std::max(counts_.voxel_asked, kVoxelsPerOff * off), up, options_);
}

/// Cuts the header's grid into tiles, and makes empty containers for triangles and voxels.
void SceneVoxelizer::cut_grid() {
  const VoxelBox grid = voxels_of(header_.bricks);
  const std::int32_t edge = options_.tile_vox > 0 ? options_.tile_vox : default_tile(grid);
  if (edge % kBrickEdge != 0 || edge > kMaxTileVox)
    fail(ErrorCode::bad_argument, "a tile of {} voxels a side is no multiple of 64 up to {}", edge, kMaxTileVox);
  tiles_ = TileGrid(grid, edge);
  const VoxelCoord size = grid.size();
  if (tiles_.total() > TileGrid::kMostTiles) {
    fail(ErrorCode::bad_argument, {Remedy::coarser_grid}, "a grid of {} x {} x {} voxels is too fine", size.x, size.y,
         size.z);
  }
  if (options_.fill == FillMode::winding && std::max({size.x, size.y, size.z}) > kWindingVoxels)
    fail(ErrorCode::bad_argument, {Remedy::flood_fill},
         "a grid over 2^24 voxels a side cannot be filled by winding numbers");
  bins_.reset();
  fill_.reset();
  on_shelf_.clear();
  shelf_ = options_.context.make_shelf();
  store_ = options_.context.make_scratch();
  bins_ = std::make_unique<TriangleBins>(tiles_, *store_);
  if (!chunks_ && options_.fill != FillMode::winding)
    bricks_ = std::make_unique<SurfaceBricks>(options_.context.memory.bytes / 10 * 3);
  // A GPU has few backends; the other threads load, label and shelve tiles meanwhile.
  const std::uint64_t fit = std::max<std::uint64_t>(1, options_.tile_memory_bytes / work_bytes(edge));
  std::vector<std::unique_ptr<TileWork>> works(
      std::min<std::uint64_t>(fit, std::uint64_t(std::max(thread_count(), backends_->count()))));
  for (auto& w : works) w = std::make_unique<TileWork>();
  works_ = std::make_unique<TileWorks>(std::move(works));
  if (options_.fill != FillMode::none)
    fill_ = std::make_unique<TileFill>(options_.fill, tiles_, *shelf_, *store_, *backends_, *works_);
}

void SceneVoxelizer::lay_grid(bool guessed) {
  const GridFrame guess = header_.frame;
  const BrickBox guessed_bricks = header_.bricks;
  const double off = counts_.scene.rounding.of(scene_.sums().bounds());
  header_ = header_of(scene_.sums().bounds(), off);
  slack_ = fixed_slack(header_.frame, off);
  sorted_ =
      guessed && scene_.sorted() && header_.frame == guess && header_.bricks == guessed_bricks && slack_ == kFixedSlack;
  if (!sorted_) cut_grid();
  if (!sorted_ && guessed) scene_.read_twice();  // no triangle stayed in memory
  counts_.read_twice = scene_.reads_twice();
  counts_.tiles = std::uint64_t(tiles_.total());
}

void SceneVoxelizer::sort_triangles() {
  if (chunks_) {
    look_up_chunks();
  } else {
    scene_.again([&](const NextPortion& next) { bin(next); });
  }
}

/// Triangles of known chunks are not read again. If all chunks are known, the scene is not read twice.
void SceneVoxelizer::look_up_chunks() {
  chunks_->look_up(header_.frame, slack_, header_.bricks, options_.context.memory.bytes / 10 * 3, *shelf_);
  counts_.chunks = chunks_->chunks();
  counts_.chunks_kept = chunks_->kept();
  if (chunks_->complete()) return;
  if (chunks_->needs_met()) scene_.read_twice();
  counts_.read_twice = scene_.reads_twice();
  PassSteps steps(options_.context.progress, "voxelizing", "triangles", counts_.scene.triangles);
  scene_.again([&](const NextPortion& next) {
    const std::uint64_t memory = options_.context.memory.bytes;
    chunks_->add_missing(next, memory / 10, memory / 5 * 3, [&](std::uint64_t n, std::vector<TriangleD>&& large) {
      if (!large.empty()) bin(sort(large));
      steps.add(n);
    });
  });
  counts_.chunks_kept = chunks_->kept();
}

/// Sets the voxels of the triangles that bricks take; sorts the others by tile.
TriangleBatch SceneVoxelizer::sort(std::span<const TriangleD> triangles) const {
  std::vector<FixedTriangle> rest;
  if (bricks_) {
    bricks_->add(triangles, header_.frame, slack_, rest);
  } else {
    const FixedFrame to_fixed(header_.frame);
    rest.reserve(triangles.size());
    for (const TriangleD& t : triangles) rest.push_back(to_fixed(t));
  }
  return bins_->sort(rest, slack_);
}

void SceneVoxelizer::bin(TriangleBatch&& batch) {
  bins_->add(std::move(batch));
  if (waiting_bytes() > options_.context.memory.bytes) make_room();
}

/// Puts triangles into bricks, or into the bins of their tiles.
void SceneVoxelizer::bin(const NextPortion& next) {
  struct Item {
    Portion portion;
    TriangleBatch batch;
  };
  PassSteps steps(options_.context.progress, "sorting", "triangles", counts_.scene.triangles);
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return next(item.portion); },
      [&](Item& item) {
        item.batch = sort(item.portion.triangles);
        if (scene_.reads_twice()) {
          scene_.give_back(std::move(item.portion.triangles));
        } else {
          std::vector<TriangleD>().swap(item.portion.triangles);
        }
      },
      [&](Item& item) {
        bin(std::move(item.batch));
        steps.add(item.portion.count);
      });
}

/// Returns the bytes that count against memory_bytes. The store and the shelf count at most as half of it: with more,
/// the bins would have nothing to grow in.
std::uint64_t SceneVoxelizer::waiting_bytes() const {
  const std::uint64_t aside = store_->memory_bytes() + shelf_->memory_bytes() + bins_->table_bytes();
  return bins_->memory_bytes() + (bricks_ ? bricks_->memory_bytes() : 0) +
         std::min(aside, options_.context.memory.bytes / 2);
}

/// Voxelizes tiles with many triangles now, since their bits are far smaller. The triangles of the other tiles go to
/// the store; all do while chunks still add to their bricks.
void SceneVoxelizer::make_room() {
  const std::uint64_t tile_bytes =
      std::uint64_t(tiles_.edge_vox) * std::uint64_t(tiles_.edge_vox) * std::uint64_t(tiles_.edge_vox) / 8;
  std::vector<std::uint64_t> many, few;
  for (const std::uint64_t tile : bins_->tiles()) {
    const std::uint64_t bytes = bins_->memory_bytes(tile);
    if (bytes > 4 * tile_bytes && !chunks_) {
      many.push_back(tile);
    } else if (bytes > 0) {
      few.push_back(tile);
    }
  }
  for (const std::uint64_t tile : many) on_shelf_[tile];  // no insertion while threads look up
  parallel_for(std::int64_t(many.size()), [&](std::int64_t i) {
    const std::uint64_t tile = many[std::size_t(i)];
    voxelize_tile(tile, on_shelf_.at(tile), false);
    bins_->release(tile);
  });
  bins_->spill(few);
}

std::vector<std::uint64_t> SceneVoxelizer::tiles_with_triangles() const {
  std::vector<std::uint64_t> tiles = bins_->tiles();
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

void SceneVoxelizer::voxelize() {
  const std::vector<std::uint64_t> tiles = tiles_with_triangles();
  for (const std::uint64_t tile : tiles) on_shelf_[tile];
  counts_.tiles_touched = tiles.size();
  PassSteps steps(options_.context.progress, "voxelizing", "tiles", tiles.size());
  parallel_for(std::int64_t(tiles.size()), [&](std::int64_t i) {
    const std::uint64_t tile = tiles[std::size_t(i)];
    voxelize_tile(tile, on_shelf_.at(tile), true);
    bins_->release(tile);
    steps.add(1);
  });
  if (fill_) fill_->resolve();
  counts_.surface_voxels = surface_voxels_;
}

/// Adds the tile's waiting triangles to its voxels. `last`: the tile gets no more triangles.
void SceneVoxelizer::voxelize_tile(std::uint64_t tile, bool& on_shelf, bool last) {
  const TileWorks::Lease work(*works_);
  const VoxelBox box = tile_box(tile);
  work->bits.reset(box);
  if (on_shelf) load_voxels(*shelf_, work->bits);
  on_shelf = true;
  if (chunks_) chunks_->bricks().take(work->bits);
  if (bricks_ && last) bricks_->take(work->bits);
  bins_->for_each(tile, [&](std::span<const FixedTriangle> triangles) {
    work->crossings.clear();
    {
      const BackendPool::Lease backend(*backends_);
      backend->voxelize(triangles, work->bits, slack_);
      if (options_.fill == FillMode::winding) backend->find_crossings(triangles, box, work->crossings);
    }
    if (fill_) fill_->add_crossings(tile, work->crossings);
  });
  store_voxels(work->bits, *shelf_);
  if (!last) return;
  surface_voxels_ += work->bits.count();
  if (fill_) fill_->add_surface(tile, work->bits);
}

void SceneVoxelizer::fill_and_emit(BrickSink& sink) {
  const PassProgress& progress = options_.context.progress;
  if (options_.fill == FillMode::winding) {
    fill_->fill_columns(progress);
    counts_.open_columns = fill_->open_columns();
  }
  const bool flood = options_.fill == FillMode::flood || options_.fill == FillMode::inside;
  const ShelvedTiles tiles{
      tiles_, *shelf_,
      [&](std::uint64_t tile) {
        if (flood) fill_->fill_flood(tile);
      },
      [&](std::uint64_t tile) { return on_shelf_.contains(tile) || (fill_ && fill_->has_filled(tile)); }};
  const EmittedBricks emitted = emit_bricks(tiles, header_.slab_axis, sink, progress);
  counts_.solid_voxels = emitted.solid_voxels;
  counts_.bricks = emitted.bricks;
  counts_.full_bricks = emitted.full_bricks;
}

}  // namespace

double voxel_size_of(const Bounds3d& bounds, std::int64_t voxels) {
  double side = 0, reach = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    side = std::max(side, bounds.max[i] - bounds.min[i]);
    reach = std::max({reach, std::abs(bounds.min[i]), std::abs(bounds.max[i])});
  }
  // Eight bits: with them the lattice of a few hundred voxels a side, near the origin, fits the 24 bits of a float32
  // (STL).
  if (side > 0) return round_up_to_bits(side / double(voxels), 8);
  return reach > 0 ? reach / (1 << 20) : 1;
}

StreamHeader solid_header(const Bounds3d& bounds, double voxel, UpAxis up, const VoxelizeOptions& options) {
  StreamHeader header;
  header.frame = make_frame(bounds, voxel, up);
  if (options.cell_vox > 0) header.frame = aligned_to_cells(header.frame, bounds, options.cell_vox);
  header.bounds = bounds;
  header.bricks = bricks_of(voxel_bounds(header.frame, bounds));
  header.slab_axis = longest_axis(header.bricks);
  header.fill = options.fill;
  return header;
}

VoxelizeCounts voxelize_stream(TriangleSource& source, const OpenSink& open, Backends& backends,
                               const VoxelizeOptions& options) {
  return SceneVoxelizer(source, backends, options)(open);
}

}  // namespace bp
