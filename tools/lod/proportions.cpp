#include "tools/lod/proportions.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/lod/choices.h"
#include "tools/notes/proportion.h"

namespace bp {

namespace {

/// The option that the voxels follow from, if it is a number that is not taken at its word; else empty.
std::string finest_target(const BuildOptions& o) {
  if (o.voxels.voxel || o.voxels.resolution || o.levels.errors.empty()) return "";
  const Length::Unit unit = o.levels.errors.front().unit;
  if (unit != Length::Unit::scene && unit != Length::Unit::pixels) return "";
  return "--error " + o.levels.errors.front().text();
}

}  // namespace

void question_proportions(const BuildOptions& o, const SceneSize& scene) {
  if (o.voxels.voxel) question_voxel("--voxel", *o.voxels.voxel, scene.bounds);
  for (const Length& error : o.levels.errors) question_length("--error", error, scene.bounds);
  const double voxel = voxel_size(o, scene);
  const bool pixels = !o.levels.errors.empty() && o.levels.errors.front().unit == Length::Unit::pixels;
  const char* const likely = pixels ? "are these pixels of a screen?" : "is the scene in other units?";
  if (const std::string what = finest_target(o); !what.empty()) question_grid(what, voxel, scene.bounds, likely);
  if (o.closing.scale) question_scale("--scale", *o.closing.scale, scene.bounds, voxel);
}

Estimate estimate_build(const BuildOptions& o, const Bounds3d& scene, const VoxelizeCounts& counts, double voxel) {
  const double effort = kLodEffort * (o.levels.errors.empty() ? 1 : kErrorEffort);
  const double coarser = o.is_tileset() ? 2 : 1;  // voxels of the next level
  Estimate all = estimate_voxelize(scene, voxel, most_touched_voxels(counts, voxel));
  for (std::size_t i = 0; i < level_count(request_of(o)); ++i) {
    const double edge = voxel * std::pow(coarser, i);
    all.then(estimate_mesh(scene, edge, effort, most_touched_voxels(counts, edge)));
  }
  return all;
}

}  // namespace bp
