#include "tools/lod/proportions.h"

#include <fmt/format.h>

#include "lib/core/error.h"
#include "tools/lod/choices.h"
#include "tools/notes/proportion.h"

namespace bp {

namespace {

/// Returns the option that decides the voxels if it may be a slip, since it is a plain number or pixels; else empty.
std::string finest_target(const BuildOptions& o) {
  if (o.voxels.voxel || o.voxels.resolution || o.levels.errors.empty()) return "";
  const Length::Unit unit = o.levels.errors.front().unit;
  if (unit != Length::Unit::scene && unit != Length::Unit::pixels) return "";
  return "--error " + o.levels.errors.front().text();
}

/// Refuses a margin of more than a fifth of the scene: a cage so far away does not follow the scene, and takes long to
/// make.
void question_margin(const BuildOptions& o, const Bounds3d& scene, double voxel) {
  constexpr double kMost = 20;  // percent
  const double diagonal = scene.diagonal(), margin = margin_of(o, diagonal, voxel);
  if (margin <= Length{kMost, Length::Unit::percent}.in_world(diagonal, voxel)) return;
  const bool slip = o.margin.unit == Length::Unit::scene && o.margin.value <= kMost;
  fail(ErrorCode::bad_argument, "--margin {} is {:.3g} % of the scene's diagonal, and {:g}% is the most{}",
       o.margin.text(), 100 * margin / diagonal, kMost,
       slip ? fmt::format(": did you mean {}%?", o.margin.text()) : "");
}

}  // namespace

void question_proportions(const BuildOptions& o, const SceneSize& scene) {
  if (o.voxels.voxel) question_voxel("--voxel", *o.voxels.voxel, scene.bounds);
  if (o.voxels.resolution) question_resolution(*o.voxels.resolution, scene.bounds);
  for (const Length& error : o.levels.errors) question_length("--error", error, scene.bounds);
  const double voxel = voxel_size(o, scene);
  const bool pixels = !o.levels.errors.empty() && o.levels.errors.front().unit == Length::Unit::pixels;
  const char* const likely = pixels ? "are these pixels of a screen?" : "is the scene in other units?";
  if (const std::string what = finest_target(o); !what.empty()) question_grid(what, voxel, scene.bounds, likely);
  if (o.closing.scale) question_scale("--scale", *o.closing.scale, scene.bounds, voxel);
  if (o.is_cage() && !scene.bounds.empty()) question_margin(o, scene.bounds, voxel);
}

Estimate estimate_build(const BuildOptions& o, const Bounds3d& scene, const VoxelizeCounts& counts, double voxel) {
  const bool follows = o.proxy.mode == MeshMode::fit,
             encloses = enclosed_by(o, counts.scene.triangles) == Enclose::scene;
  const bool tiles_of_scene = o.is_tileset() && encloses;
  Estimate e =
      estimate_levels(scene, counts, voxel, level_count(request_of(o)), o.is_tileset(),
                      (o.levels.errors.empty() ? 1 : kErrorEffort) * (tiles_of_scene ? kTilesOfSceneEffort : 1));
  e.bytes += (follows ? kBytesOfFollowed : encloses ? kBytesOfEnclosed : 0) * double(counts.scene.triangles);
  return e;
}

}  // namespace bp
