#include "lib/stage/voxelize_stage.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "lib/backend/cpu_backend.h"
#include "lib/core/content_hash.h"
#include "lib/core/error.h"
#include "lib/core/hex.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"
#include "lib/grid/cells.h"
#include "lib/grid/outside.h"
#include "lib/stage/chunked_surface.h"
#include "lib/stage/triangle_bins.h"
#include "lib/voxel/winding.h"

namespace bp {

namespace {

constexpr double kMaxTiles = 1 << 27;      // the fills visit every tile; beyond, a grid is a slip of the finger
constexpr std::int32_t kMaxTileVox = 512;  // Crossing has 9 bits

/// A tile at work.
struct Work {
  BitBox bits;
  std::vector<Crossing> crossings;
};

/// Steps of one stage of the work, reported from any thread.
class Steps {
 public:
  Steps(const VoxelizeOptions& options, const char* stage, const char* unit, std::uint64_t total)
      : options_(options), stage_(stage), unit_(unit), total_(total) {}
  void add(std::uint64_t n) {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    done_ += n;
    options_.progress(stage_, unit_, done_, total_);
  }

 private:
  const VoxelizeOptions& options_;
  const char *stage_, *unit_;
  std::uint64_t total_, done_ = 0;
  std::mutex mutex_;
};

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

std::string text_of(const ContentHash& hash) {
  const auto [high, low] = hash.value().words;
  return hex_of(high, low);
}

/// One run of voxelize_stream().
class Run {
 public:
  Run(TriangleSource& source, Backends& backends, const VoxelizeOptions& options)
      : source_(source), options_(options), shelf_(options.make_shelf()), store_(options.make_store()) {
    if (options.results != nullptr && options.fill != FillMode::winding)
      chunks_ = std::make_unique<ChunkedSurface>(*options.results);
    for (int i = 0; backends.empty() && i < thread_count(); ++i) own_.push_back(std::make_unique<CpuBackend>());
    std::vector<Backend*> all;
    for (const auto& backend : backends.empty() ? own_ : backends) all.push_back(backend.get());
    backends_ = std::make_unique<Pool<Backend*>>(std::move(all));
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
  /// What waits for a tile beside its triangles.
  struct Tile {
    bool on_shelf = false;  ///< some of its triangles were voxelized early
    std::vector<ChunkStore::Handle> crossings;
  };
  struct Slab;

  void measure();
  void lay_grid();
  using Portion = ChunkedSurface::Portion;
  using NextPortion = ChunkedSurface::NextPortion;
  void sort_triangles();
  void read_again(const std::function<void(const NextPortion&)>& body);
  void bin(const NextPortion& next);
  void bin(TriangleBatch&& batch);
  [[nodiscard]] std::vector<FixedTriangle> to_fixed(std::span<const TriangleD> triangles) const;
  void look_up_chunks();
  void drop_met();
  [[nodiscard]] std::vector<std::uint64_t> tiles_with_triangles() const;
  [[nodiscard]] std::uint64_t waiting_bytes() const;
  void make_room();
  void voxelize();
  void voxelize_tile(std::uint64_t tile, Tile& state, bool last);
  void put_crossings(Tile& state, std::span<const Crossing> crossings);
  void get_crossings(std::uint64_t tile, std::vector<Crossing>& out) const;
  void fill_and_emit(BrickSink& sink);
  void fill_flood(std::uint64_t tile);
  void fill_winding_columns();
  void fill_winding_column(std::int32_t tx, std::int32_t ty);
  void list_bricks(Slab& slab) const;
  void emit(const Slab& slab, BrickSink& sink);
  [[nodiscard]] VoxelBox tile_box(std::uint64_t tile) const { return tiles_.box(tiles_.coord(tile)); }

  TriangleSource& source_;
  const VoxelizeOptions& options_;
  Backends own_;  ///< if none were given
  std::unique_ptr<Pool<Backend*>> backends_;
  std::unique_ptr<Pool<std::unique_ptr<Work>>> work_;
  std::unique_ptr<BrickShelf> shelf_;
  std::unique_ptr<ChunkStore> store_;
  VoxelizeCounts counts_;

  Bounds3d bounds_;
  std::vector<Portion> kept_;
  std::size_t dropped_ = 0;                         ///< first of kept_ that drop_met() has not settled
  std::uint64_t dropped_end_ = 0, kept_bytes_ = 0;  ///< triangles before it; of those that stay
  std::unique_ptr<ChunkedSurface> chunks_;          ///< instead of bins_, for all but large triangles
  StreamHeader header_;
  TileGrid tiles_;
  std::unique_ptr<TriangleBins> bins_;
  std::unordered_map<std::uint64_t, Tile> touched_;
  std::mutex join_mutex_;
  std::unique_ptr<OutsideFlood> flood_;
  std::atomic<std::uint64_t> surface_voxels_{0}, open_columns_{0};
};

/// First pass: bounds and counts. The triangles stay while they fit in three fifths of the memory; their bins, half as
/// large, then fit beside them.
void Run::measure() {
  struct Item {
    std::vector<TriangleD> triangles;
    std::vector<std::uint32_t> places;
    Bounds3d bounds;
  };
  Steps steps(options_, "reading", "triangles", 0);
  const std::uint64_t limit = options_.memory_bytes / 5 * 3;
  ContentHash hash;
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return source_.read(item.triangles); },
      [&](Item& item) {
        for (const TriangleD& t : item.triangles) {
          for (const Vec3d& p : t) item.bounds.add(p);
        }
        if (chunks_) item.places = ChunkCutter::places(item.triangles);
        if (item.triangles.capacity() > item.triangles.size() / 4 * 5) item.triangles.shrink_to_fit();
      },
      [&](Item& item) {
        hash.add(std::as_bytes(std::span(item.triangles)));
        if (chunks_) chunks_->measure(item.triangles, item.places);
        bounds_.merge(item.bounds);
        steps.add(item.triangles.size());
        if (counts_.read_twice) return;
        kept_bytes_ += item.triangles.capacity() * sizeof(TriangleD);
        const std::uint64_t count = item.triangles.size();
        kept_.push_back({std::move(item.triangles), count});
        if (chunks_) drop_met();
        if (kept_bytes_ <= limit) return;
        counts_.read_twice = true;
        std::vector<Portion>().swap(kept_);
      });
  counts_.scene = source_.counts();
  counts_.input_hash = text_of(hash);
  if (bounds_.empty()) {
    const SceneCounts& c = counts_.scene;
    fail(ErrorCode::bad_input,
         "{}: no triangles ({} degenerate, {} non-finite, {} bad faces skipped); a scene needs at least one with an "
         "area",
         source_.name(), c.degenerate, c.non_finite, c.bad_faces);
  }
}

/// Triangles whose voxels are probably known do not stay.
void Run::drop_met() {
  for (; dropped_ < kept_.size(); ++dropped_) {
    Portion& portion = kept_[dropped_];
    const std::uint64_t end = dropped_end_ + portion.count;
    if (!chunks_->ended(end)) return;
    if (chunks_->met(dropped_end_, end)) {
      kept_bytes_ -= portion.triangles.capacity() * sizeof(TriangleD);
      std::vector<TriangleD>().swap(portion.triangles);
    }
    dropped_end_ = end;
  }
}

void Run::lay_grid() {
  counts_.voxel_asked = options_.voxel_size(bounds_);
  header_ = solid_header(bounds_, counts_.voxel_asked, options_.up ? *options_.up : source_.up().value_or(UpAxis::y),
                         options_);
  const VoxelBox grid = voxels_of(header_.bricks);
  const std::int32_t edge = options_.tile_vox > 0 ? options_.tile_vox : default_tile(grid);
  if (edge % kBrickEdge != 0 || edge > kMaxTileVox)
    fail(ErrorCode::bad_argument, "a tile of {} voxels a side is no multiple of 64 up to {}", edge, kMaxTileVox);
  tiles_ = TileGrid(grid, edge);
  const VoxelCoord size = grid.size();
  if (tiles_.total() > kMaxTiles) {
    fail(ErrorCode::bad_argument,
         "a grid of {} x {} x {} voxels is too fine; use a larger --voxel or a smaller --resolution", size.x, size.y,
         size.z);
  }
  if (options_.fill == FillMode::winding && std::max({size.x, size.y, size.z}) > kWindingVoxels)
    fail(ErrorCode::bad_argument, "a grid over 2^24 voxels a side cannot be filled by winding; use --fill flood");
  counts_.tiles = std::uint64_t(tiles_.total());
  // A GPU has few backends: the other threads load, label and shelve meanwhile.
  const std::uint64_t fit = std::max<std::uint64_t>(1, options_.tile_memory_bytes / work_bytes(edge));
  std::vector<std::unique_ptr<Work>> work(
      std::min<std::uint64_t>(fit, std::uint64_t(std::max(thread_count(), backends_->count()))));
  for (auto& w : work) w = std::make_unique<Work>();
  work_ = std::make_unique<Pool<std::unique_ptr<Work>>>(std::move(work));
  if (options_.fill != FillMode::none) flood_ = std::make_unique<OutsideFlood>(grid, VoxelCoord{edge, edge, edge});
}

/// Second pass: from the triangles that stay, or from the scene.
void Run::read_again(const std::function<void(const NextPortion&)>& body) {
  if (!counts_.read_twice) {
    std::size_t i = 0;
    body([&](Portion& portion) {
      if (i == kept_.size()) return false;
      portion = std::move(kept_[i++]);
      return true;
    });
    return;
  }
  source_.rewind();
  ContentHash hash;
  body([&](Portion& portion) {
    const bool more = source_.read(portion.triangles);
    portion.count = portion.triangles.size();
    hash.add(std::as_bytes(std::span(portion.triangles)));
    return more;
  });
  if (text_of(hash) != counts_.input_hash)
    fail(ErrorCode::bad_input, "{}: changed between the first and the second reading", source_.name());
}

void Run::sort_triangles() {
  bins_ = std::make_unique<TriangleBins>(tiles_, *store_);
  if (chunks_) {
    look_up_chunks();
  } else {
    read_again([&](const NextPortion& next) { bin(next); });
  }
  kept_.clear();
}

/// The triangles of chunks that are known are not looked at again; if all are, the scene is not read twice.
void Run::look_up_chunks() {
  chunks_->look_up(header_.frame, header_.bricks, options_.memory_bytes / 10 * 3, *shelf_);
  counts_.chunks = chunks_->chunks();
  counts_.chunks_kept = chunks_->kept();
  if (chunks_->complete()) return;
  if (chunks_->needs_met()) counts_.read_twice = true;
  Steps steps(options_, "voxelizing", "triangles", counts_.scene.triangles);
  read_again([&](const NextPortion& next) {
    chunks_->add_missing(next, options_.memory_bytes / 10, [&](std::uint64_t n, std::vector<TriangleD>&& large) {
      if (!large.empty()) bin(bins_->sort(to_fixed(large)));
      steps.add(n);
    });
  });
}

std::vector<FixedTriangle> Run::to_fixed(std::span<const TriangleD> triangles) const {
  std::vector<FixedTriangle> fixed;
  fixed.reserve(triangles.size());
  for (const TriangleD& t : triangles) fixed.push_back(bp::to_fixed(header_.frame, t));
  return fixed;
}

void Run::bin(TriangleBatch&& batch) {
  bins_->add(std::move(batch));
  if (waiting_bytes() > options_.memory_bytes) make_room();
}

/// Triangles to fixed point, into the bins of their tiles.
void Run::bin(const NextPortion& next) {
  struct Item {
    Portion portion;
    TriangleBatch batch;
  };
  Steps steps(options_, "sorting", "triangles", counts_.scene.triangles);
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
std::uint64_t Run::waiting_bytes() const {
  const std::uint64_t aside = store_->memory_bytes() + shelf_->memory_bytes();
  return bins_->memory_bytes() + std::min(aside, options_.memory_bytes / 2);
}

/// Tiles with many triangles are voxelized now: their bits are far smaller. The triangles of the others go to the
/// store; so do all while chunks still add to their bricks.
void Run::make_room() {
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
  for (const std::uint64_t tile : many) touched_[tile];  // no insertion while threads look up
  parallel_for(std::int64_t(many.size()), [&](std::int64_t i) {
    const std::uint64_t tile = many[std::size_t(i)];
    voxelize_tile(tile, touched_.at(tile), false);
    bins_->release(tile);
  });
  bins_->spill(few);
}

std::vector<std::uint64_t> Run::tiles_with_triangles() const {
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

void Run::voxelize() {
  const std::vector<std::uint64_t> tiles = tiles_with_triangles();
  for (const std::uint64_t tile : tiles) touched_[tile];
  counts_.tiles_touched = tiles.size();
  Steps steps(options_, "voxelizing", "tiles", tiles.size());
  parallel_for(std::int64_t(tiles.size()), [&](std::int64_t i) {
    const std::uint64_t tile = tiles[std::size_t(i)];
    voxelize_tile(tile, touched_.at(tile), true);
    bins_->release(tile);
    steps.add(1);
  });
  if (flood_) flood_->resolve();
  counts_.surface_voxels = surface_voxels_;
}

/// Adds the tile's waiting triangles to its voxels; `last`: there will be no more of them.
void Run::voxelize_tile(std::uint64_t tile, Tile& state, bool last) {
  const Pool<std::unique_ptr<Work>>::Lease work(*work_);
  const VoxelBox box = tile_box(tile);
  work->bits.reset(box);
  if (state.on_shelf) load_voxels(*shelf_, work->bits);
  state.on_shelf = true;
  if (chunks_) chunks_->bricks().take(work->bits);
  bins_->for_each(tile, [&](std::span<const FixedTriangle> triangles) {
    work->crossings.clear();
    {
      const Pool<Backend*>::Lease backend(*backends_);
      backend->voxelize(triangles, work->bits);
      if (options_.fill == FillMode::winding) backend->find_crossings(triangles, box, work->crossings);
    }
    put_crossings(state, work->crossings);
  });
  store_voxels(work->bits, *shelf_);
  if (!last) return;
  surface_voxels_ += work->bits.count();
  if (!flood_) return;
  OutsideFlood::Labels labels = OutsideFlood::label(work->bits, box);
  const std::lock_guard lock(join_mutex_);
  flood_->join(std::move(labels));
}

void Run::put_crossings(Tile& state, std::span<const Crossing> crossings) {
  if (!crossings.empty()) state.crossings.push_back(store_->put(std::as_bytes(crossings)));
}

void Run::get_crossings(std::uint64_t tile, std::vector<Crossing>& out) const {
  out.clear();
  const auto at = touched_.find(tile);
  if (at == touched_.end()) return;
  std::vector<std::byte> bytes;
  for (const ChunkStore::Handle h : at->second.crossings) {
    store_->get(h, bytes);
    const std::size_t old = out.size();
    out.resize(old + bytes.size() / sizeof(Crossing));
    std::memcpy(static_cast<void*>(out.data() + old), bytes.data(), bytes.size());
  }
}

/// The tiles, and then the bricks, of one step across the slab axis.
struct Run::Slab {
  std::vector<std::uint64_t> tiles;
  std::vector<BrickCoord> bricks;  ///< not empty, in slab order
};

void Run::fill_and_emit(BrickSink& sink) {
  if (options_.fill == FillMode::winding) fill_winding_columns();
  const int axis = header_.slab_axis;
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  Steps steps(options_, "filling", "slabs", std::uint64_t(tiles_.count[axis]));
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
                       [&](std::int64_t i) { fill_flood(slab.tiles[std::size_t(i)]); });
        }
        list_bricks(slab);
      },
      [&](Slab& slab) {
        emit(slab, sink);
        steps.add(1);
      });
}

void Run::fill_flood(std::uint64_t tile) {
  const VoxelBox box = tile_box(tile);
  const bool without_surface = options_.fill == FillMode::inside && touched_.count(tile) > 0;
  if (!flood_->has_enclosed(box) && !without_surface) return;
  const Pool<std::unique_ptr<Work>>::Lease work(*work_);
  work->bits.reset(box);
  load_voxels(*shelf_, work->bits);
  BitBox surface;
  if (without_surface) surface = work->bits;
  flood_->fill_enclosed(box, work->bits);
  for (std::int64_t i = 0; i < surface.word_count(); ++i) work->bits.data()[i] &= ~surface.data()[i];
  store_voxels(work->bits, *shelf_);
}

void Run::list_bricks(Slab& slab) const {
  for (const std::uint64_t tile : slab.tiles) {
    const BrickBox bricks = bricks_of(tile_box(tile));
    for (std::int32_t z = bricks.min.z; z < bricks.max.z; ++z) {
      for (std::int32_t y = bricks.min.y; y < bricks.max.y; ++y) {
        for (std::int32_t x = bricks.min.x; x < bricks.max.x; ++x) {
          if (shelf_->fill({x, y, z}) != BrickFill::empty) slab.bricks.push_back({x, y, z});
        }
      }
    }
  }
  std::sort(slab.bricks.begin(), slab.bricks.end(),
            [&](BrickCoord p, BrickCoord q) { return slab_order(header_.slab_axis, p, q); });
}

void Run::emit(const Slab& slab, BrickSink& sink) {
  Brick brick;
  for (const BrickCoord c : slab.bricks) {
    brick.coord = c;
    brick.fill = shelf_->get(c, brick.bits);
    shelf_->drop(c);
    for (const std::uint64_t w : brick.bits) counts_.solid_voxels += std::uint64_t(std::popcount(w));
    ++counts_.bricks;
    if (brick.fill == BrickFill::full) ++counts_.full_bricks;
    sink.write(brick);
  }
}

void Run::fill_winding_columns() {
  Steps steps(options_, "filling", "columns", std::uint64_t(tiles_.count.x) * std::uint64_t(tiles_.count.y));
  const std::int64_t nx = tiles_.count.x;
  parallel_for(nx * tiles_.count.y, [&](std::int64_t i) {
    fill_winding_column(std::int32_t(i % nx), std::int32_t(i / nx));
    steps.add(1);
  });
  counts_.open_columns = open_columns_;
}

/// One column of tiles: first the columns of voxels whose crossings cancel, then the fill from below.
void Run::fill_winding_column(std::int32_t tx, std::int32_t ty) {
  const Pool<std::unique_ptr<Work>>::Lease work(*work_);
  const VoxelCoord size = tiles_.box({tx, ty, 0}).size();
  const std::size_t width = std::size_t(size.x), words = (width + 63) / 64;
  std::vector<std::int32_t> numbers(width * std::size_t(size.y), 0);
  for (std::int32_t tz = 0; tz < tiles_.count.z; ++tz) {
    get_crossings(tiles_.index({tx, ty, tz}), work->crossings);
    add_crossings(work->crossings, tiles_.box({tx, ty, tz}), numbers);
  }
  std::vector<std::uint64_t> open(words * std::size_t(size.y), 0);
  std::uint64_t open_count = 0;
  for (std::size_t y = 0; y < std::size_t(size.y); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      if (numbers[x + y * width] == 0) continue;
      open[y * words + x / 64] |= std::uint64_t(1) << (x % 64);
      ++open_count;
    }
  }
  open_columns_ += open_count;
  numbers.assign(numbers.size(), 0);
  BitBox flooded;
  for (std::int32_t tz = 0; tz < tiles_.count.z; ++tz) {
    const std::uint64_t tile = tiles_.index({tx, ty, tz});
    const VoxelBox box = tile_box(tile);
    get_crossings(tile, work->crossings);
    const bool flood = open_count > 0 && flood_->has_enclosed(box);
    const bool wound = std::any_of(numbers.begin(), numbers.end(), [](std::int32_t n) { return n != 0; });
    if (work->crossings.empty() && !flood && !wound) continue;
    work->bits.reset(box);
    load_voxels(*shelf_, work->bits);
    if (flood) {
      flooded = work->bits;
      flood_->fill_enclosed(box, flooded);
    }
    Pool<Backend*>::Lease(*backends_)->fill_winding(work->crossings, open, numbers, work->bits);
    for (std::int32_t z = box.min.z; flood && z < box.max.z; ++z) {
      for (std::size_t w = 0; w < open.size(); ++w) {
        work->bits.row(box.min.y, z)[w] |= flooded.row(box.min.y, z)[w] & open[w];
      }
    }
    store_voxels(work->bits, *shelf_);
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
  return Run(source, backends, options)(open);
}

}  // namespace bp
