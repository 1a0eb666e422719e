#include "lib/pass/close/close_pass.h"

#include <atomic>
#include <mutex>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/grid/header_fault.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/close/detail/earlier_tiles.h"
#include "lib/pass/close/detail/layer_writer.h"
#include "lib/pass/close/detail/tile_choice.h"
#include "lib/pass/close/detail/tile_closer.h"
#include "lib/pass/close/detail/tile_reader.h"

namespace bp {

namespace {

using TileBoxes = Pool<std::unique_ptr<BitBox>>;

TileBoxes make_boxes(std::size_t count) {
  std::vector<std::unique_ptr<BitBox>> boxes(count);
  for (auto& box : boxes) box = std::make_unique<BitBox>();
  return TileBoxes(std::move(boxes));
}

/// Closes a stream.
class StreamCloser {
 public:
  StreamCloser(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& scale,
               const ClosingParams& params, const CloseOptions& options)
      : options_(options),
        cubes_(params.turned() ? each_cube_once(*params.orientation) : OrientationField{}),
        params_{params.element, params.turned() ? &cubes_ : nullptr},
        axis_(source.header().slab_axis),
        widest_(widest_halo(scale.upper_bound(source.header().frame), params_)),
        earlier_(options.earlier, scale, source.header().frame, params_),
        plan_(plan_tiles(voxels_of(closing_bricks(source.header(), scale, params_)), widest_, params_.turned(),
                         earlier_.mostly_stays(), backends.size(), options.tile_vox, options.context.memory)),
        solid_(options.context.make_shelf()),
        closing_(options.context.make_shelf()),
        closer_({source.header(), *solid_, scale, with_memory(params_, plan_)}, *closing_, backends, plan_.at_work),
        boxes_(make_boxes(plan_.at_work)),
        reader_(source, *solid_, plan_.tiles, widest_),
        writer_(*solid_, *closing_, axis_, sink) {
    if (!options_.keep_cavities) closer_.flood(plan_.tiles.voxels, plan_.tiles.edge_vox);
  }

  CloseCounts operator()() {
    options_.context.report("closing", "tiles", 0, 0);
    std::uint64_t done = 0;
    pipeline<TileCoord>(
        plan_.at_work + 2, [&](TileCoord& tile) { return reader_.next(tile); },
        [&](const TileCoord& tile) { close(tile); },
        [&](const TileCoord& tile) {
          options_.context.report("closing", "tiles", ++done, 0);
          while (const auto slab = options_.keep_cavities ? reader_.take_before(tile[axis_]) : std::nullopt)
            write(*slab);
        });
    reader_.read_rest();
    if (closer_.floods()) closer_.resolve();
    finish_slabs();
    return counts();
  }

 private:
  using SlabTiles = TileReader::SlabTiles;

  static ClosingParams with_memory(ClosingParams params, const TilePlan& plan) {
    if (params.turned()) params.cube_bytes = plan.cube_bytes;
    return params;
  }

  void close(TileCoord tile);
  void finish_slabs();
  void fill_cavities(std::int32_t slab, SlabTiles& tiles);
  void write(const SlabTiles& tiles);
  [[nodiscard]] CloseCounts counts() const;

  const CloseOptions& options_;
  const OrientationField cubes_;
  const ClosingParams params_;
  const int axis_;
  const Halo widest_;
  const EarlierTiles earlier_;
  const TilePlan plan_;
  const std::unique_ptr<BrickShelf> solid_, closing_;
  TileCloser closer_;
  TileBoxes boxes_;  ///< closed tiles: as many as threads work on them
  TileReader reader_;
  LayerWriter writer_;
  std::atomic<std::uint64_t> tiles_closed_{0}, cavity_voxels_{0};
  std::atomic<std::int32_t> halo_vox_{0};
};

CloseCounts StreamCloser::counts() const {
  CloseCounts counts;
  counts.tile_vox = plan_.tiles.edge_vox;
  counts.tiles = std::uint64_t(plan_.tiles.total());
  counts.tiles_closed = tiles_closed_;
  counts.halo_vox = halo_vox_;
  counts.solid_bricks = writer_.solid_bricks, counts.closing_bricks = writer_.closing_bricks;
  counts.cavity_voxels = cavity_voxels_;
  counts.seconds = {reader_.seconds,  closer_.waiting, closer_.closing, closer_.labelling,
                    closer_.shelving, closer_.filling, writer_.seconds};
  counts.ignored_bricks = reader_.ignored_bricks;
  return counts;
}

void StreamCloser::close(TileCoord tile) {
  const VoxelBox box = plan_.tiles.box(tile);
  const bool stays = earlier_.stays(box);
  Halo halo;
  if (!stays) {
    halo = closer_.halo(box);
    if (!closer_.in_reach(box, halo)) return;
    ++tiles_closed_;
    for (std::int32_t most = halo_vox_;
         most < halo.total_vox() && !halo_vox_.compare_exchange_weak(most, halo.total_vox());)
      ;
  }
  const TileBoxes::Lease closed(boxes_);
  if (stays) {
    earlier_.load(box, *closed);
  } else {
    closer_.close(box, halo, *closed);
  }
  closer_.keep(box, *closed);
}

/// Fills and writes the remaining slabs. One is filled while the one before is written.
void StreamCloser::finish_slabs() {
  auto left = reader_.take_all();
  std::size_t next = 0, written = 0;
  pipeline<std::size_t>(
      2,
      [&](std::size_t& i) {
        i = next;
        return next++ < left.size();
      },
      [&](const std::size_t& i) {
        if (closer_.floods()) fill_cavities(left[i].first, left[i].second);
      },
      [&](const std::size_t& i) {
        write(left[i].second);
        options_.context.report("filling", "slabs", ++written, left.size());
      });
}

/// Fills the cavities of a slab, also in tiles that hold no voxel. A slab of nothing but such tiles is open to the
/// outside.
void StreamCloser::fill_cavities(std::int32_t slab, SlabTiles& tiles) {
  TileCoord count = plan_.tiles.count;
  count[axis_] = 1;
  const std::int64_t total = std::int64_t(count.x) * count.y * count.z;
  std::mutex mutex;
  parallel_for(total, [&](std::int64_t i) {
    TileCoord tile{std::int32_t(i % count.x), std::int32_t(i / count.x % count.y), std::int32_t(i / count.x / count.y)};
    tile[axis_] = slab;
    const VoxelBox box = plan_.tiles.box(tile);
    if (!closer_.has_enclosed(box)) return;
    const TileBoxes::Lease bits(boxes_);
    cavity_voxels_ += closer_.fill(box, *bits, options_.filled);
    const std::lock_guard lock(mutex);
    tiles.insert(tile);
  });
}

/// Writes both layers of the bricks of these tiles.
void StreamCloser::write(const SlabTiles& tiles) {
  std::vector<BrickCoord> bricks;
  for (const TileCoord& tile : tiles) {
    for_each_brick(plan_.tiles.box(tile), [&](BrickCoord c) {
      if (writer_.holds(c)) bricks.push_back(c);
    });
  }
  writer_.write(std::move(bricks));
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
