#include "lib/levels/tiles/tile_pyramid.h"

#include "lib/core/error.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"

namespace bp {

TilePyramid::TilePyramid(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                         PyramidOptions options)
    : header_(header), solid_(std::move(solid)), backends_(backends), options_(std::move(options)) {
  if (solid_->coords().empty()) fail(ErrorCode::bad_input, "the scene fills no voxel; there is nothing to mesh");
  surface_ = options_.context.make_shelf();
  boundary_layer(*solid_, *surface_);
}

void TilePyramid::add_level(TileParams params) {
  auto closing = options_.context.make_shelf();
  close_cells(header_, *solid_, backends_, params.scale_world,
              {options_.cells, options_.closing, false, options_.context}, *closing);
  waiting_.push_back({std::move(closing), nullptr, nullptr});
  params.element = options_.closing.element;
  tasks_.push_back(
      {level_, {header_, *solid_, *surface_, *waiting_.back().closing, options_.cells}, std::move(params)});
  added_ = true;
}

void TilePyramid::drop_tasks() {
  tasks_.clear();
  waiting_.clear();
  added_ = false;
}

void TilePyramid::reduce() {
  auto solid = options_.context.make_shelf(), surface = options_.context.make_shelf();
  bp::reduce(*solid_, header_.frame, *solid);
  bp::reduce(*surface_, header_.frame, *surface);
  header_ = reduced(header_);
  if (added_) {
    waiting_.back().solid = std::move(solid_);
    waiting_.back().surface = std::move(surface_);
    added_ = false;
  }
  solid_ = std::move(solid);
  surface_ = std::move(surface);
  ++level_;
}

}  // namespace bp
