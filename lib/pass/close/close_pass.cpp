#include "lib/pass/close/close_pass.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/grid/header_fault.h"
#include "lib/grid/shelf_stream.h"
#include "lib/grid/tile_grid.h"
#include "lib/pass/close/detail/earlier_tiles.h"
#include "lib/pass/close/detail/tile_choice.h"
#include "lib/pass/close/detail/tile_closer.h"

namespace bp {

namespace {

constexpr std::size_t kBricksAtATime = 128;  // bricks that are taken off the shelf together to be written: 8 MiB

/// Closes a stream. A slab here is one step of tiles across the slab axis.
class StreamCloser {
 public:
  StreamCloser(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& scale,
               const ClosingParams& params, const CloseOptions& options)
      : source_(source),
        sink_(sink),
        scale_(scale),
        cubes_(params.turned() ? each_cube_once(*params.orientation) : OrientationField{}),
        params_{params.element, params.turned() ? &cubes_ : nullptr},
        options_(options),
        header_(source.header()),
        axis_(header_.slab_axis),
        widest_(widest_halo(scale.upper_bound(header_.frame), params_)),
        earlier_(options.earlier, scale, header_.frame, params_),
        solid_(options.context.make_shelf()),
        closing_(options.context.make_shelf()) {
    lay_tiles(backends);
  }

  CloseCounts operator()() {
    options_.context.report("closing", "tiles", 0, 0);
    more_ = source_.read(brick_);
    pipeline<TileCoord>(
        boxes_->count() + 2, [&](TileCoord& tile) { return next_tile(tile); },
        [&](const TileCoord& tile) { close(tile); },
        [&](const TileCoord& tile) {
          options_.context.report("closing", "tiles", ++done_, 0);
          if (options_.keep_cavities) emit_done(tile[axis_]);
        });
    read_before(std::numeric_limits<std::int64_t>::max());  // to the end record
    if (closer_->floods()) closer_->resolve();
    finish_slabs();
    counts_.tiles_closed = tiles_closed_;
    counts_.cavity_voxels = cavity_voxels_;
    counts_.halo_vox = halo_vox_;
    counts_.seconds = {reading_,          closer_->waiting, closer_->closing, closer_->labelling,
                       closer_->shelving, closer_->filling, writing_};
    return counts_;
  }

 private:
  using SlabTiles = std::set<TileCoord>;

  void lay_tiles(Backends& backends);
  bool next_tile(TileCoord& tile);
  void read_before(std::int64_t end_vox);
  void take_brick();
  void close(TileCoord tile);
  void finish_slabs();
  void fill_cavities(std::int32_t slab, SlabTiles& tiles);
  void emit_done(std::int32_t current_slab);
  void emit(const SlabTiles& tiles);
  /// Returns the first voxel across the slab axis that is no longer in the slab.
  [[nodiscard]] std::int64_t end_of(std::int32_t slab) const {
    return tiles_.voxels.min[axis_] + (std::int64_t(slab) + 1) * tiles_.edge_vox;
  }

  BrickSource& source_;
  BrickSink& sink_;
  const ScaleField& scale_;
  const OrientationField cubes_;
  ClosingParams params_;
  const CloseOptions& options_;
  const StreamHeader& header_;
  const int axis_;
  const Halo widest_;
  const EarlierTiles earlier_;
  const std::unique_ptr<BrickShelf> solid_, closing_;
  TileGrid tiles_;
  std::unique_ptr<TileCloser> closer_;
  std::unique_ptr<Pool<std::unique_ptr<BitBox>>> boxes_;  ///< closed tiles: as many as threads work on them
  CloseCounts counts_;
  std::uint64_t done_ = 0;
  std::atomic<std::uint64_t> tiles_closed_{0}, cavity_voxels_{0};
  std::atomic<std::int32_t> halo_vox_{0};
  std::atomic<double> reading_{0}, writing_{0};

  Brick brick_;  ///< read from the source, and not yet taken
  bool more_ = true;
  std::vector<TileCoord> queue_;  ///< tiles of the slab that is closed now, last first
  std::int32_t next_slab_ = 0;
  std::mutex slabs_mutex_;
  /// Slabs that are not yet emitted: their tiles with a solid brick in reach.
  std::map<std::int32_t, SlabTiles> slabs_;
};

void StreamCloser::lay_tiles(Backends& backends) {
  const VoxelBox grid = voxels_of(closing_bricks(header_, scale_, params_));
  const MemoryShare& memory = options_.context.memory;
  const bool turned = params_.turned();
  // A GPU has few backends: while they compute, the other threads label and shelve tiles.
  const std::size_t workers = std::max(backends.size(), std::size_t(thread_count()));
  // Halos are cheap on a GPU, so that small tiles keep all threads busy.
  const bool small = backends.size() < workers && widest_.total_vox() <= kMaxTileVox / 8;
  const std::int32_t largest = earlier_.mostly_stays() ? EarlierTiles::kMostVox : small ? kMaxTileVox / 2 : kMaxTileVox;
  const std::int32_t edge = options_.tile_vox != 0
                                ? options_.tile_vox
                                : choose_tile(grid.size(), widest_, workers, memory.bytes, largest, turned);
  if (edge < 0 || edge % kBrickEdge != 0)
    fail(ErrorCode::bad_argument, "a tile of {} voxels a side is no multiple of {}", edge, kBrickEdge);
  const double bytes = tile_bytes(grid.size(), edge, widest_, turned);
  if (bytes > double(memory.bytes)) {
    const auto needed = std::uint64_t(std::ceil(bytes));
    Remedies others{Remedy::larger_voxels, Remedy::smaller_scale};
    if (edge > kBrickEdge) others.push_back(Remedy::smaller_tiles);
    throw NeedsMemory(fmt::format("closing a tile of {} voxels with a halo of {}", edge, widest_.total_vox()), needed,
                      memory.bytes, memory.limit_with(needed - memory.bytes), others);
  }
  tiles_ = TileGrid(grid, edge);
  if (tiles_.total() > TileGrid::kMostTiles)
    fail(ErrorCode::bad_argument, {Remedy::larger_tiles}, "the grid has {:.0f} tiles of {} voxels", tiles_.total(),
         edge);
  const auto fit = std::size_t(std::max(1.0, std::min(double(workers), double(memory.bytes) / bytes)));
  // The rest of the memory is for the rows of turned cubes: the more cubes at once, the fewer sweeps over the solid.
  if (turned) params_.cube_bytes = turned_cubes_bytes(widest_.dilation_vox) + left_of(memory.bytes, bytes, fit);
  closer_ =
      std::make_unique<TileCloser>(TileCloser::Input{header_, *solid_, scale_, params_}, *closing_, backends, fit);
  std::vector<std::unique_ptr<BitBox>> boxes(fit);
  for (auto& box : boxes) box = std::make_unique<BitBox>();
  boxes_ = std::make_unique<Pool<std::unique_ptr<BitBox>>>(std::move(boxes));
  if (!options_.keep_cavities) closer_->flood(grid, edge);
  counts_.tile_vox = edge;
  counts_.tiles = std::uint64_t(tiles_.total());
}

/// Returns the next tile, slab by slab, once all bricks that any tile of the slab can see have been taken.
bool StreamCloser::next_tile(TileCoord& tile) {
  while (queue_.empty()) {
    if (next_slab_ == tiles_.count[axis_]) return false;
    read_before(end_of(next_slab_) + widest_.total_vox());
    const std::lock_guard lock(slabs_mutex_);
    const auto found = slabs_.lower_bound(next_slab_);
    if (found == slabs_.end() && !more_) return false;
    if (found != slabs_.end() && found->first == next_slab_)
      queue_.assign(found->second.rbegin(), found->second.rend());
    ++next_slab_;
  }
  tile = queue_.back();
  queue_.pop_back();
  return true;
}

/// Takes the bricks that begin before `end_vox` across the slab axis.
void StreamCloser::read_before(std::int64_t end_vox) {
  const Stopwatch watch(reading_);
  while (more_ && std::int64_t(brick_.coord[axis_]) * kBrickEdge < end_vox) {
    take_brick();
    more_ = source_.read(brick_);
  }
}

void StreamCloser::take_brick() {
  if (brick_.layer != Layer::solid) {
    ++counts_.ignored_bricks;
    return;
  }
  solid_->put(brick_.coord, brick_.fill, brick_.bits);
  const BrickCoord next{brick_.coord.x + 1, brick_.coord.y + 1, brick_.coord.z + 1};
  const VoxelBox reach = intersect(voxels_of({brick_.coord, next}).grown(widest_.dilation_vox), tiles_.voxels);
  const std::lock_guard lock(slabs_mutex_);
  for_each(tiles_.tiles_of(reach), [&](TileCoord t) { slabs_[t[axis_]].insert(t); });
}

void StreamCloser::close(TileCoord tile) {
  const VoxelBox box = tiles_.box(tile);
  const bool stays = earlier_.stays(box);
  Halo halo;
  if (!stays) {
    halo = closer_->halo(box);
    if (!closer_->in_reach(box, halo)) return;
    ++tiles_closed_;
    for (std::int32_t most = halo_vox_;
         most < halo.total_vox() && !halo_vox_.compare_exchange_weak(most, halo.total_vox());)
      ;
  }
  const Pool<std::unique_ptr<BitBox>>::Lease closed(*boxes_);
  if (stays) {
    earlier_.load(box, *closed);
  } else {
    closer_->close(box, halo, *closed);
  }
  closer_->keep(box, *closed);
}

/// Fills and emits the remaining slabs. One is filled while the one before is written.
void StreamCloser::finish_slabs() {
  std::vector<std::pair<std::int32_t, SlabTiles>> left(slabs_.begin(), slabs_.end());
  slabs_.clear();
  std::size_t next = 0, written = 0;
  pipeline<std::size_t>(
      2,
      [&](std::size_t& i) {
        i = next;
        return next++ < left.size();
      },
      [&](const std::size_t& i) {
        if (closer_->floods()) fill_cavities(left[i].first, left[i].second);
      },
      [&](const std::size_t& i) {
        emit(left[i].second);
        options_.context.report("filling", "slabs", ++written, left.size());
      });
}

/// Fills the cavities of a slab, also in tiles that hold no voxel. A slab of nothing but such tiles is open to the
/// outside.
void StreamCloser::fill_cavities(std::int32_t slab, SlabTiles& tiles) {
  TileCoord count = tiles_.count;
  count[axis_] = 1;
  const std::int64_t total = std::int64_t(count.x) * count.y * count.z;
  std::mutex mutex;
  parallel_for(total, [&](std::int64_t i) {
    TileCoord tile{std::int32_t(i % count.x), std::int32_t(i / count.x % count.y), std::int32_t(i / count.x / count.y)};
    tile[axis_] = slab;
    if (!closer_->has_enclosed(tiles_.box(tile))) return;
    const Pool<std::unique_ptr<BitBox>>::Lease bits(*boxes_);
    cavity_voxels_ += closer_->fill(tiles_.box(tile), *bits, options_.filled);
    const std::lock_guard lock(mutex);
    tiles.insert(tile);
  });
}

/// Emits the slabs before `current` that no tile from there on can see.
void StreamCloser::emit_done(std::int32_t current) {
  for (;;) {
    SlabTiles tiles;
    {
      const std::lock_guard lock(slabs_mutex_);
      const auto first = slabs_.begin();
      if (first == slabs_.end() || end_of(first->first) + widest_.total_vox() > end_of(current - 1)) return;
      tiles = std::move(first->second);
      slabs_.erase(first);
    }
    emit(tiles);
  }
}

/// Emits both layers of the bricks of these tiles, in slab order. Every solid brick lies in the closing.
void StreamCloser::emit(const SlabTiles& tiles) {
  const Stopwatch watch(writing_);
  std::vector<BrickCoord> bricks;
  for (const TileCoord& tile : tiles) {
    for_each_brick(tiles_.box(tile), [&](BrickCoord c) {
      if (closing_->fill(c) != BrickFill::empty) bricks.push_back(c);
    });
  }
  std::sort(bricks.begin(), bricks.end(), [&](BrickCoord a, BrickCoord b) { return slab_order(axis_, a, b); });
  struct Layers {
    Brick solid, closing;
  };
  std::vector<Layers> some(std::min(bricks.size(), kBricksAtATime));
  const auto fetch = [](BrickShelf& shelf, BrickCoord c, Layer layer, Brick& out) {
    out.coord = c;
    out.layer = layer;
    out.fill = shelf.get(c, out.bits);
    if (out.fill != BrickFill::empty) shelf.drop(c);
  };
  for (std::size_t at = 0; at < bricks.size(); at += some.size()) {
    const std::size_t n = std::min(some.size(), bricks.size() - at);
    parallel_for(std::int64_t(n), [&](std::int64_t i) {
      const BrickCoord c = bricks[at + std::size_t(i)];
      fetch(*solid_, c, Layer::solid, some[std::size_t(i)].solid);
      fetch(*closing_, c, Layer::closing, some[std::size_t(i)].closing);
    });
    for (std::size_t i = 0; i < n; ++i) {
      for (const Brick* brick : {&some[i].solid, &some[i].closing}) {
        if (brick->fill == BrickFill::empty) continue;
        ++(brick->layer == Layer::solid ? counts_.solid_bricks : counts_.closing_bricks);
        sink_.write(*brick);
      }
    }
  }
}

}  // namespace

BrickBox closing_bricks(const StreamHeader& header, const ScaleField& scale, const ClosingParams& params) {
  if (header.bricks.empty()) return header.bricks;
  const std::int32_t margin = ceil_div(element_reach(scale.upper_bound(header.frame), params) + 1, kBrickEdge);
  const BrickBox grown = header.bricks.grown(margin);
  if (brick_box_fault(grown) != nullptr)
    fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "the closing leaves the grid of 2^31 voxels a side");
  return grown;
}

CloseCounts close_stream(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& scale,
                         const ClosingParams& params, const CloseOptions& options) {
  return StreamCloser(source, sink, backends, scale, params, options)();
}

std::unique_ptr<BrickShelf> close_shelf(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                        const ScaleField& scale, const ClosingParams& params,
                                        const CloseOptions& options) {
  auto closing = options.context.make_shelf();
  ShelfSource source(header, solid, nullptr, ShelfSource::Keep::all);
  ShelfSink sink(nullptr, closing.get());
  close_stream(source, sink, backends, scale, params, options);
  return closing;
}

}  // namespace bp
