#include "lib/stage/tile_pyramid.h"

#include "lib/core/error.h"
#include "lib/grid/boundary_runs.h"
#include "lib/grid/reduce.h"

namespace bp {

TilePyramid::TilePyramid(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                         PyramidOptions options)
    : header_(header), solid_(std::move(solid)), backends_(backends), options_(std::move(options)) {
  if (solid_->coords().empty()) fail(ErrorCode::bad_input, "the scene fills no voxel; there is nothing to mesh");
  surface_ = options_.make_shelf();
  boundary_layer(*solid_, *surface_);
}

std::unique_ptr<BrickShelf> TilePyramid::close(double scale_world) {
  CellClosing o;
  o.cells = options_.cells;
  o.closing = options_.closing;
  o.keep_cavities = options_.keep_cavities;
  o.memory_bytes = options_.memory_bytes;
  o.store = options_.store;
  o.progress = options_.progress;
  auto closing = options_.make_shelf();
  close_cells(header_, *solid_, backends_, scale_world, o, *closing);
  return closing;
}

void TilePyramid::make(double scale_world, TileParams params, const TileEncoder& encode,
                       const std::function<void(LevelTile&&)>& consume) {
  const auto closing = close(scale_world);
  params.scale_world = scale_world;
  params.element = options_.closing.element;
  params.memory_bytes = options_.memory_bytes;
  params.make_shelf = options_.make_shelf;
  params.store = options_.store;
  params.progress = options_.progress;
  make_tiles({header_, *solid_, *surface_, *closing, options_.cells}, params, encode, consume);
}

void TilePyramid::reduce() {
  auto solid = options_.make_shelf(), surface = options_.make_shelf();
  bp::reduce(*solid_, header_.frame, *solid);
  bp::reduce(*surface_, header_.frame, *surface);
  header_ = reduced(header_);
  solid_ = std::move(solid);
  surface_ = std::move(surface);
}

}  // namespace bp
