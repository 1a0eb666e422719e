#include "lib/levels/tiles/tile_plan.h"

#include <algorithm>

#include "lib/volume/reduce.h"

namespace bp {

namespace {

double scale_of(const LodTarget& target, double voxel) {
  if (target.scale_world) return *target.scale_world;
  if (target.error_world > 0) return std::max(target.error_world / kScalesPerLength, (1 + kBeyondWholeVox) * voxel);
  return TilesetPlan::kScaleVox * voxel;
}

std::int64_t longest_side(const VoxelBox& box) {
  const VoxelCoord size = box.size();
  return std::max({size.x, size.y, size.z});
}

/// Returns the number of levels: the number that is asked for, else at least so many that the root is one mesh.
std::size_t level_count_with(const LevelRequest& request, std::size_t cut) {
  const std::size_t asked = level_count(request);
  return is_explicit(request) ? asked : std::max(asked, cut + 1);
}

}  // namespace

Halo halo_at(double scale_world, const GridFrame& frame) {
  ScaleField field;
  field.base = scale_world;
  const std::int32_t reach = element_reach(field.upper_bound(frame));
  return {reach + 1, reach};
}

TilesetPlan plan_tileset(const LevelRequest& request, Cells cells, const StreamHeader& header) {
  TilesetPlan plan;
  plan.uncut = header;
  VoxelBox solid = voxel_bounds(header.frame, header.bounds);
  std::uint64_t number = 0;
  std::size_t level = 0;
  const auto is_cut = [&] {
    return cells_spanned(cells, plan.uncut.bricks).count() > 1 &&
           (level == 0 || longest_side(solid) > TilesetPlan::kWholeVox);
  };
  for (; level < level_count_with(request, level) && is_cut(); ++level) {
    const LodTarget target = tile_target(request, level);
    const GridFrame& frame = plan.uncut.frame;
    const double scale = scale_of(target, frame.voxel);
    // A closing reaches one voxel beyond what it closes.
    const CellSpan span = cells_spanned(cells, solid.grown(1));
    plan.cut.push_back({target, frame, scale, halo_at(scale, frame), span, number});
    number += span.count();
    plan.uncut = reduced(plan.uncut);
    solid = halved(solid);  // the origins of frames that are aligned to cells are even
  }
  plan.whole = level_count_with(request, level) - level;
  return plan;
}

std::size_t levels_to_one_mesh(LevelRequest request, Cells cells, const StreamHeader& header) {
  request.levels = kMostLevels;
  return plan_tileset(request, cells, header).cut.size() + 1;
}

}  // namespace bp
