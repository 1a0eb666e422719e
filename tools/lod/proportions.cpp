#include "tools/lod/proportions.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/notes/proportion.h"

namespace bp {

namespace {

/// The option that the voxels follow from, if it is a number that is not taken at its word; else empty.
std::string finest_target(const BuildOptions& o) {
  if (o.voxel || o.resolution) return "";
  if (!o.request.pixels.empty()) return fmt::format("--screen {}", o.request.pixels.front());
  if (o.request.errors.empty() || o.request.errors.front().unit != Length::Unit::scene) return "";
  return "--error " + o.request.errors.front().text();
}

}  // namespace

void question_proportions(const BuildOptions& o, const SceneSize& scene) {
  if (o.voxel) question_voxel("--voxel", *o.voxel, scene.bounds);
  for (const Length& error : o.request.errors) question_length("--error", error, scene.bounds);
  const double voxel = voxel_size(o, scene);
  const char* const likely =
      o.request.pixels.empty() ? "is the scene in other units?" : "are these pixels of a screen?";
  if (const std::string what = finest_target(o); !what.empty()) question_grid(what, voxel, scene.bounds, likely);
  if (o.request.scale) question_scale("--scale", *o.request.scale, scene.bounds, voxel);
}

Estimate estimate_build(const BuildOptions& o, const Bounds3d& scene, const VoxelizeCounts& counts, double voxel) {
  const bool measures = !o.request.errors.empty() || !o.request.pixels.empty();
  const double effort = kLodEffort * (measures ? kErrorEffort : 1);
  const double coarser = o.profile == LodProfile::tiles ? 2 : 1;  // voxels of the next level
  Estimate all = estimate_voxelize(scene, voxel, most_touched_voxels(counts, voxel));
  for (std::size_t i = 0; i < level_count(o.request); ++i) {
    const double edge = voxel * std::pow(coarser, i);
    all.then(estimate_mesh(scene, edge, effort, most_touched_voxels(counts, edge)));
  }
  return all;
}

}  // namespace bp
