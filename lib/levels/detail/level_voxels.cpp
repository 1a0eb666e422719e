#include "lib/levels/detail/level_voxels.h"

#include <cmath>
#include <utility>
#include <vector>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/hide/possible_rooms.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/surface/repair.h"
#include "lib/volume/reduce.h"
#include "lib/volume/topology.h"

namespace bp {

namespace {

void add_voxels(const BrickShelf& from, BrickShelf& to) {
  for (const BrickCoord at : from.coords()) {
    BitBox added(voxels_of({at, {at.x + 1, at.y + 1, at.z + 1}})), all(added.box());
    load_voxels(from, added);
    load_voxels(to, all);
    for (std::int64_t i = 0; i < all.word_count(); ++i) all.data()[i] |= added.data()[i];
    store_voxels(all, to);
  }
}

}  // namespace

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

std::unique_ptr<BrickShelf> LevelVoxels::with_rooms(const Solid& solid, const ScaleField& field,
                                                    const PassContext& context) {
  std::vector<double> scales;
  for (double scale = field.base; scale >= kLeastScaleVox * solid.header.frame.voxel; scale /= std::sqrt(2.0))
    scales.insert(scales.begin(), scale);
  HiddenOptions options;
  options.context = context;
  const std::vector<bool> possible = field.constant() ? possible_rooms(solid.header, *solid.shelf, scales, options)
                                                      : std::vector<bool>(scales.size(), true);
  std::unique_ptr<BrickShelf> all;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    if (!possible[i]) continue;
    const auto rooms = context.make_shelf();
    CloseOptions close;
    close.context = context;
    close.filled = rooms.get();
    (void)close_shelf(solid.header, *solid.shelf, backends_, field.scaled(scales[i] / field.base),
                      {StructuringElement::cube}, close);
    if (rooms->coords().empty()) continue;
    if (!all) add_voxels(*solid.shelf, *(all = context.make_shelf()));
    add_voxels(*rooms, *all);
  }
  return all;
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
      const auto filled = options_.mode == MeshMode::fit ? with_rooms(solid, closed.scale, context) : nullptr;
      closing.voxels =
          close_shelf(solid.header, filled ? *filled : *solid.shelf, backends_, closed.scale, options_.closing, close);
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
