#include "lib/levels/detail/level_voxels.h"

#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/surface/repair.h"
#include "lib/volume/reduce.h"
#include "lib/volume/topology.h"

namespace bp {

LevelVoxels::LevelVoxels(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                         const LodOptions& options)
    : backends_(backends), options_(options) {
  if (solid->coords().empty()) fail(ErrorCode::bad_input, "the scene fills no voxel; there is nothing to mesh");
  solids_.push_back({header, std::move(solid), 0});
}

const LevelVoxels::Solid& LevelVoxels::reduced(int n) {
  const std::lock_guard lock(mutex_);
  while (int(solids_.size()) <= n) {
    const Solid& fine = solids_.back();
    auto coarse = options_.context.make_shelf();
    isolated([&] { reduce(*fine.shelf, fine.header.frame, *coarse); });
    solids_.push_back({bp::reduced(fine.header), std::move(coarse), fine.reductions + 1});
  }
  return solids_[std::size_t(n)];
}

ScaleField LevelVoxels::field_at(const Solid& solid, double scale, const PassContext& context) const {
  ScaleField constant;
  constant.base = scale;
  if (!options_.field) return constant;
  ScalePlan plan = *options_.field;
  plan.field = plan.field.scaled(scale / plan.field.base);
  return measured(plan, solid.header, *solid.shelf, {0, context}).field;
}

LevelVoxels::Closing LevelVoxels::closed_at(const Solid& solid, double scale, const PassContext& context) {
  CloseOptions close;
  close.context = context;
  Closing closing = as_it_is(solid, scale);
  StreamHeader& closed = closing.header;
  closed.scale = field_at(solid, scale, context);
  {
    const std::lock_guard lock(closing_);
    isolated([&] {
      closing.voxels = close_shelf(solid.header, *solid.shelf, backends_, closed.scale, options_.closing, close);
    });
  }
  closed.bricks = closing_bricks(solid.header, closed.scale);
  closed.has_closing = true;
  closed.element = options_.closing.element;
  return closing;
}

std::uint64_t parts_and_holes(const LevelVoxels::Closing& closing, const PieceMemory& memory) {
  repair_contacts(*closing.voxels);
  const std::uint64_t bytes = topology_bytes(*closing.voxels),
                      most = memory.bytes();  // meshing has not begun, so its memory is free
  if (bytes > most) throw NeedsMemory("counting the parts and holes of a level", bytes, most, memory.limit_for(bytes));
  const SolidTopology topology = topology_of(*closing.voxels);
  return topology.parts + topology.handles;
}

}  // namespace bp
