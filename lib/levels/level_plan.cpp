#include "lib/levels/level_plan.h"

#include <algorithm>

#include "lib/levels/tiles/level_tiles.h"
#include "lib/levels/voxel_choice.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"

namespace bp {

namespace {

double dense_faces(double area, const Bounds3d& bounds, double voxel) {
  return kDensePerArea * std::min(area, area_of(bounds)) / (voxel * voxel);
}

PlannedLevel planned(const CutLevel& cut, double area, const Bounds3d& bounds) {
  PlannedLevel level{cut.frame.voxel, cut.scale_world, cut.halo.total_vox(), cut.cells.count(), cut.number, 0, true};
  if (cut.target.error_world > 0) return level;
  const auto least = double(level.tiles * TileParams::kLeastTileFaces);
  const double by_surface = dense_faces(area, bounds, level.voxel) / double(kDensePerFace);
  level.faces = cut.target.faces > 0 ? cut.target.faces * level.tiles : std::uint64_t(std::max(by_surface, least));
  return level;
}

/// Appends `count` levels that are one mesh each, at the scales and voxels that LodChain tries first. `header`: the
/// header of their solid.
void add_whole(std::vector<PlannedLevel>& levels, const LevelRequest& request, const StreamHeader& header,
               std::size_t count, double area, bool keep_voxels) {
  const VoxelCoord side = voxel_bounds(header.frame, header.bounds).size();
  const LodGround ground{header.frame.voxel, header.bounds.diagonal(),
                         std::uint64_t(dense_faces(area, header.bounds, header.frame.voxel)),
                         std::max({side.x, side.y, side.z})};
  const std::size_t since = levels.size();
  double scale = since > 0 ? TilesetPlan::kScaleVox * header.frame.voxel : 0;
  int reductions = 0;
  for (std::size_t i = 0; i < count; ++i) {
    LodTarget target = level_target(request, since + i, since, ground.dense_faces);
    target.keep_voxels = keep_voxels && i == 0;
    if (i >= request.faces.size() && i > 0 && target.faces > 0 && target.faces >= levels.back().faces) continue;
    scale = first_scale(ground, target, scale);
    reductions = reductions_for(ground, target, scale, reductions);
    GridFrame frame = header.frame;
    for (int n = 0; n < reductions; ++n) frame = reduced(frame);
    levels.push_back({frame.voxel, scale, halo_at(scale, frame).total_vox(), 1, i, target.faces, false});
  }
}

}  // namespace

std::uint64_t planned_dense_faces(double area, const Bounds3d& bounds, double voxel) {
  return std::uint64_t(dense_faces(area, bounds, voxel));
}

std::vector<PlannedLevel> planned_chain(const LevelRequest& request, const StreamHeader& header, double area,
                                        bool keep_voxels) {
  std::vector<PlannedLevel> levels;
  add_whole(levels, request, header, level_count(request), area, keep_voxels);
  return levels;
}

std::vector<PlannedLevel> planned_tileset(const TilesetPlan& plan, const LevelRequest& request,
                                          const StreamHeader& header, double area) {
  std::vector<PlannedLevel> levels;
  for (const CutLevel& cut : plan.cut) levels.push_back(planned(cut, area, header.bounds));
  add_whole(levels, request, plan.uncut, plan.whole, area, false);
  for (PlannedLevel& level : levels)
    if (!level.cut) level.number = plan.whole_number();
  return levels;
}

}  // namespace bp
