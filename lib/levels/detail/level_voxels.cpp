#include "lib/levels/detail/level_voxels.h"

#include <utility>

#include "lib/core/error.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/surface/repair.h"
#include "lib/volume/reduce.h"
#include "lib/volume/topology.h"

namespace bp {

LevelVoxels::LevelVoxels(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                         const LodOptions& options)
    : header_(header), solid_(std::move(solid)), backends_(backends), options_(options) {
  if (solid_->coords().empty()) fail(ErrorCode::bad_input, "the scene fills no voxel; there is nothing to mesh");
}

void LevelVoxels::reduce_to(int n) {
  for (; reductions_ < n; ++reductions_) {
    auto coarse = options_.context.make_shelf();
    reduce(*solid_, header_.frame, *coarse);
    header_ = reduced(header_);
    solid_ = std::move(coarse);
  }
}

ScaleField LevelVoxels::field_at(double scale) const {
  ScaleField constant;
  constant.base = scale;
  if (!options_.field) return constant;
  ScalePlan plan = *options_.field;
  plan.field = plan.field.scaled(scale / plan.field.base);
  return measured(plan, header_, *solid_, {0, options_.context}).field;
}

LevelVoxels::Closing LevelVoxels::closed_at(double scale) const {
  CloseOptions close;
  close.context = options_.context;
  Closing closing = as_it_is(scale);
  StreamHeader& closed = closing.header;
  closed.scale = field_at(scale);
  closing.voxels = close_shelf(header_, *solid_, backends_, closed.scale, options_.closing, close);
  closed.bricks = closing_bricks(header_, closed.scale);
  closed.has_closing = true;
  closed.element = options_.closing.element;
  return closing;
}

std::uint64_t LevelVoxels::parts_and_holes(const Closing& closing) const {
  repair_contacts(*closing.voxels);
  const PieceMemory& memory = options_.context.pieces;  // of meshing, which takes nothing of it yet
  const std::uint64_t bytes = topology_bytes(*closing.voxels), most = memory.bytes();
  if (bytes > most) throw NeedsMemory("counting the parts and holes of a level", bytes, most, memory.limit_for(bytes));
  const SolidTopology topology = topology_of(*closing.voxels);
  return topology.parts + topology.handles;
}

}  // namespace bp
