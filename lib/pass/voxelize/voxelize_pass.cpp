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
#include "lib/grid/clip.h"
#include "lib/grid/count_bits.h"
#include "lib/pass/voxelize/detail/chunked_surface.h"
#include "lib/pass/voxelize/detail/scene_passes.h"
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

/// A tile at work: its bits, those of its fill, the labels of its faces and runs; and a block of triangles.
std::uint64_t work_bytes(std::int32_t edge_vox) {
  const auto edge = std::uint64_t(edge_vox);
  return 3 * edge * edge * edge / 8 + (std::uint64_t(4) << 20);
}

/// Voxelizes a scene.
class SceneVoxelizer {
 public:
  SceneVoxelizer(TriangleSource& source, Backends& backends, const VoxelizeOptions& options)
      : source_(source),
        options_(options),
        shelf_(options.context.make_shelf()),
        store_(options.context.make_scratch()),
        chunks_(options.context.results != nullptr && options.fill != FillMode::winding
                    ? std::make_unique<ChunkedSurface>(*options.context.results, options.context.turn)
                    : nullptr),
        // Their bins, half as large, then fit beside them.
        scene_(source, options.context.memory.bytes / 5 * 3, chunks_.get()) {
    for (int i = 0; backends.empty() && i < thread_count(); ++i) own_.push_back(std::make_unique<CpuBackend>());
    std::vector<Backend*> all;
    for (const auto& backend : backends.empty() ? own_ : backends) all.push_back(backend.get());
    backends_ = std::make_unique<BackendPool>(std::move(all));
  }

  VoxelizeCounts operator()(const OpenSink& open) {
    measure();
    lay_grid();
    BrickSink& sink = open(header_, counts_);
    sort_triangles();
    voxelize();
    fill_and_emit(sink);
    counts_.scratch_bytes = store_->scratch_bytes();
    return counts_;
  }

 private:
  struct Slab;

  void measure();
  void lay_grid();
  using Portion = ScenePasses::Portion;
  using NextPortion = ScenePasses::NextPortion;
  void sort_triangles();
  void bin(const NextPortion& next);
  void bin(TriangleBatch&& batch);
  [[nodiscard]] std::vector<FixedTriangle> to_fixed(std::span<const TriangleD> triangles) const;
  void look_up_chunks();
  [[nodiscard]] std::vector<std::uint64_t> tiles_with_triangles() const;
  [[nodiscard]] std::uint64_t waiting_bytes() const;
  void make_room();
  void voxelize();
  void voxelize_tile(std::uint64_t tile, bool& on_shelf, bool last);
  void fill_and_emit(BrickSink& sink);
  void list_bricks(Slab& slab) const;
  void emit(const Slab& slab, BrickSink& sink);
  [[nodiscard]] VoxelBox tile_box(std::uint64_t tile) const { return tiles_.box(tiles_.coord(tile)); }

  TriangleSource& source_;
  const VoxelizeOptions& options_;
  Backends own_;  ///< if none were given
  std::unique_ptr<BackendPool> backends_;
  std::unique_ptr<TileWorks> works_;
  std::unique_ptr<BrickShelf> shelf_;
  std::unique_ptr<Scratch> store_;
  VoxelizeCounts counts_;

  std::unique_ptr<ChunkedSurface> chunks_;  ///< instead of bins_, for all but large triangles
  ScenePasses scene_;
  StreamHeader header_;
  TileGrid tiles_;
  std::unique_ptr<TriangleBins> bins_;
  std::unordered_map<std::uint64_t, bool> on_shelf_;  ///< tiles: some of their triangles were voxelized early
  std::unique_ptr<TileFill> fill_;                    ///< null: FillMode::none
  std::atomic<std::uint64_t> surface_voxels_{0};
};

void SceneVoxelizer::measure() {
  scene_.measure(options_.context.progress);
  counts_.scene = source_.counts();
  counts_.area = scene_.area();
  counts_.extent = scene_.extent();
  counts_.stray = scene_.sums().stray();
  counts_.signed_volume = scene_.sums().volume();
  counts_.input_hash = scene_.input_hash();
  counts_.read_twice = scene_.reads_twice();
}

void SceneVoxelizer::lay_grid() {
  counts_.voxel_asked = options_.voxel_size(scene_.bounds());
  header_ = solid_header(scene_.bounds(), counts_.voxel_asked,
                         options_.up ? *options_.up : source_.up().value_or(UpAxis::y), options_);
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
  counts_.tiles = std::uint64_t(tiles_.total());
  // A GPU has few backends: the other threads load, label and shelve meanwhile.
  const std::uint64_t fit = std::max<std::uint64_t>(1, options_.tile_memory_bytes / work_bytes(edge));
  std::vector<std::unique_ptr<TileWork>> works(
      std::min<std::uint64_t>(fit, std::uint64_t(std::max(thread_count(), backends_->count()))));
  for (auto& w : works) w = std::make_unique<TileWork>();
  works_ = std::make_unique<TileWorks>(std::move(works));
  if (options_.fill != FillMode::none)
    fill_ = std::make_unique<TileFill>(options_.fill, tiles_, *shelf_, *store_, *backends_, *works_);
}

void SceneVoxelizer::sort_triangles() {
  bins_ = std::make_unique<TriangleBins>(tiles_, *store_);
  if (chunks_) {
    look_up_chunks();
  } else {
    scene_.again([&](const NextPortion& next) { bin(next); });
  }
  scene_.release();
}

/// The triangles of chunks that are known are not looked at again; if all are, the scene is not read twice.
void SceneVoxelizer::look_up_chunks() {
  chunks_->look_up(header_.frame, header_.bricks, options_.context.memory.bytes / 10 * 3, *shelf_);
  counts_.chunks = chunks_->chunks();
  counts_.chunks_kept = chunks_->kept();
  if (chunks_->complete()) return;
  if (chunks_->needs_met()) scene_.read_twice();
  counts_.read_twice = scene_.reads_twice();
  PassSteps steps(options_.context.progress, "voxelizing", "triangles", counts_.scene.triangles);
  scene_.again([&](const NextPortion& next) {
    const std::uint64_t memory = options_.context.memory.bytes;
    chunks_->add_missing(next, memory / 10, memory / 5 * 3, [&](std::uint64_t n, std::vector<TriangleD>&& large) {
      if (!large.empty()) bin(bins_->sort(to_fixed(large)));
      steps.add(n);
    });
  });
  counts_.chunks_kept = chunks_->kept();
}

std::vector<FixedTriangle> SceneVoxelizer::to_fixed(std::span<const TriangleD> triangles) const {
  std::vector<FixedTriangle> fixed;
  fixed.reserve(triangles.size());
  for (const TriangleD& t : triangles) fixed.push_back(bp::to_fixed(header_.frame, t));
  return fixed;
}

void SceneVoxelizer::bin(TriangleBatch&& batch) {
  bins_->add(std::move(batch));
  if (waiting_bytes() > options_.context.memory.bytes) make_room();
}

/// Triangles to fixed point, into the bins of their tiles.
void SceneVoxelizer::bin(const NextPortion& next) {
  struct Item {
    Portion portion;
    TriangleBatch batch;
  };
  PassSteps steps(options_.context.progress, "sorting", "triangles", counts_.scene.triangles);
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return next(item.portion); },
      [&](Item& item) {
        const std::vector<FixedTriangle> fixed = to_fixed(item.portion.triangles);
        std::vector<TriangleD>().swap(item.portion.triangles);
        item.batch = bins_->sort(fixed);
      },
      [&](Item& item) {
        bin(std::move(item.batch));
        steps.add(item.portion.count);
      });
}

/// What fills memory_bytes. Were more than half of it put aside, the bins would have nothing to grow in.
std::uint64_t SceneVoxelizer::waiting_bytes() const {
  const std::uint64_t aside = store_->memory_bytes() + shelf_->memory_bytes() + bins_->table_bytes();
  return bins_->memory_bytes() + std::min(aside, options_.context.memory.bytes / 2);
}

/// Tiles with many triangles are voxelized now: their bits are far smaller. The triangles of the others go to the
/// store; so do all while chunks still add to their bricks.
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
  if (!chunks_) return tiles;
  for (const BrickCoord brick : chunks_->bricks().coords()) {
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

/// Adds the tile's waiting triangles to its voxels; `last`: there will be no more of them.
void SceneVoxelizer::voxelize_tile(std::uint64_t tile, bool& on_shelf, bool last) {
  const TileWorks::Lease work(*works_);
  const VoxelBox box = tile_box(tile);
  work->bits.reset(box);
  if (on_shelf) load_voxels(*shelf_, work->bits);
  on_shelf = true;
  if (chunks_) chunks_->bricks().take(work->bits);
  bins_->for_each(tile, [&](std::span<const FixedTriangle> triangles) {
    work->crossings.clear();
    {
      const BackendPool::Lease backend(*backends_);
      backend->voxelize(triangles, work->bits);
      if (options_.fill == FillMode::winding) backend->find_crossings(triangles, box, work->crossings);
    }
    if (fill_) fill_->add_crossings(tile, work->crossings);
  });
  store_voxels(work->bits, *shelf_);
  if (!last) return;
  surface_voxels_ += work->bits.count();
  if (fill_) fill_->add_surface(tile, work->bits);
}

/// The tiles, and then the bricks, of one step across the slab axis.
struct SceneVoxelizer::Slab {
  std::vector<std::uint64_t> tiles;
  std::vector<BrickCoord> bricks;  ///< not empty, in slab order
};

void SceneVoxelizer::fill_and_emit(BrickSink& sink) {
  if (options_.fill == FillMode::winding) {
    fill_->fill_columns(options_.context.progress);
    counts_.open_columns = fill_->open_columns();
  }
  const int axis = header_.slab_axis;
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  PassSteps steps(options_.context.progress, "filling", "slabs", std::uint64_t(tiles_.count[axis]));
  TileCoord at{};
  pipeline<Slab>(
      2,
      [&](Slab& slab) {
        if (at[axis] == tiles_.count[axis]) return false;
        for (at[b] = 0; at[b] < tiles_.count[b]; ++at[b]) {
          for (at[a] = 0; at[a] < tiles_.count[a]; ++at[a]) slab.tiles.push_back(tiles_.index(at));
        }
        ++at[axis];
        return true;
      },
      [&](Slab& slab) {
        if (options_.fill == FillMode::flood || options_.fill == FillMode::inside) {
          parallel_for(std::int64_t(slab.tiles.size()),
                       [&](std::int64_t i) { fill_->fill_flood(slab.tiles[std::size_t(i)]); });
        }
        list_bricks(slab);
      },
      [&](Slab& slab) {
        emit(slab, sink);
        steps.add(1);
      });
}

void SceneVoxelizer::list_bricks(Slab& slab) const {
  for (const std::uint64_t tile : slab.tiles) {
    // Most tiles of a wide grid hold nothing: their bricks are not asked one by one.
    if (!on_shelf_.contains(tile) && !(fill_ && fill_->has_filled(tile))) continue;
    for_each_brick(tile_box(tile), [&](BrickCoord c) {
      if (shelf_->fill(c) != BrickFill::empty) slab.bricks.push_back(c);
    });
  }
  std::sort(slab.bricks.begin(), slab.bricks.end(),
            [&](BrickCoord p, BrickCoord q) { return slab_order(header_.slab_axis, p, q); });
}

void SceneVoxelizer::emit(const Slab& slab, BrickSink& sink) {
  Brick brick;
  for (const BrickCoord c : slab.bricks) {
    brick.coord = c;
    brick.fill = shelf_->get(c, brick.bits);
    shelf_->drop(c);
    counts_.solid_voxels += count_bits(std::as_bytes(std::span(brick.bits)));
    ++counts_.bricks;
    if (brick.fill == BrickFill::full) ++counts_.full_bricks;
    sink.write(brick);
  }
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
