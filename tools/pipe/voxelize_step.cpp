#include "tools/pipe/voxelize_step.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/scene/scene_format.h"
#include "io/store/scratch.h"
#include "io/stream/brick_shelf.h"
#include "lib/levels/voxel_choice.h"
#include "tools/cli/names.h"
#include "tools/notes/proportion.h"
#include "tools/notes/up_note.h"

namespace bp {

namespace {

/// Returns the voxel size. It is called when the scene has been read once.
double voxel_size(const VoxelOptions& voxels, const Bounds3d& bounds) {
  if (voxels.resolution) question_resolution(*voxels.resolution, bounds);
  if (!voxels.voxel) return voxel_size_of(bounds, voxels.resolution.value_or(kDefaultResolution));
  question_voxel("--voxel", *voxels.voxel, bounds);
  return voxels.voxel->in_world(bounds.diagonal(), 0);
}

}  // namespace

OptionText voxelize_text(const VoxelOptions& voxels, UpAxis up, bool told) {
  OptionText text;
  if (voxels.voxel) {
    text.add("voxel", *voxels.voxel);
  } else {
    text.add("resolution", voxels.resolution.value_or(kDefaultResolution));
  }
  text.add("fill", name_of(voxels.fill)).add("up", name_of(up));
  if (told && up == UpAxis::y) text.add(kUpTold, true);
  return text;
}

VoxelizeOptions voxelize_options(const VoxelOptions& voxels, const CommonOptions& common,
                                 const VoxelizeBudget& budget) {
  VoxelizeOptions v;
  v.voxel_size = [&voxels](const Bounds3d& bounds) { return voxel_size(voxels, bounds); };
  v.voxel_by_bounds = true;
  v.fill = voxels.fill;
  v.up = voxels.up;
  v.context.memory.bytes = budget.waiting;
  v.tile_memory_bytes = budget.tiles;
  v.context.make_shelf = make_shelf_factory(budget.shelf, common.temp);
  v.context.make_scratch = [bytes = budget.store, temp = common.temp] { return make_scratch(bytes, temp); };
  return v;
}

SceneFiles scene_files(const VoxelOptions& voxels, const VoxelizeCounts& counts) {
  const std::string format = voxels.format.empty() ? "" : scene_format_named(voxels.format);
  SceneFiles scene{{}, format, counts.scene.triangles, counts.input_hash};
  for (const std::string& name : voxels.scenes) {
    std::error_code none;
    if (name == "-" || !std::filesystem::is_regular_file(name, none)) return {};
    scene.files.push_back({name, std::filesystem::file_size(name, none)});
  }
  return scene;
}

void note_voxels(Report& report, const CommonOptions& common, const StreamHeader& header, const VoxelizeCounts& counts,
                 const SceneAgain& scene) {
  if (header.frame.voxel != counts.voxel_asked) {
    report.notes.push_back(
        fmt::format("the voxel size was rounded from {} to {}, so that every vertex of a proxy is an exact double",
                    counts.voxel_asked, header.frame.voxel));
  }
  for (const std::string& text : scene_notes(counts, header, scene)) report.note(text, common);
  if (counts.open_columns == 0) return;
  report.note(fmt::format("{} columns of voxels cross an open or inconsistently oriented surface; the flood decided "
                          "there, and elsewhere the inside may be missing; --fill flood needs no orientation",
                          counts.open_columns),
              common);
}

}  // namespace bp
