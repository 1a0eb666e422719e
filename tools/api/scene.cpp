#include "tools/api/scene.h"

#include "io/scene/scene_format.h"
#include "io/tiles/tileset_folder.h"
#include "lib/core/error.h"
#include "tools/api/call.h"
#include "tools/api/structs.h"
#include "tools/run/inputs.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"

namespace bp::api {

std::unique_ptr<TriangleSource> Scene::open(const SceneOptions& options) const {
  if (arrays) return filtered(name, arrays->open(), options);
  SceneOptions named = options;
  named.format = format;
  return open_scenes(files, named);
}

namespace {

Scene scene_of_files(const char* const* paths, std::size_t count, const char* format) {
  Scene scene;
  if (count == 0) fail(ErrorCode::bad_argument, "no file is named");
  (void)needed(paths, "the list of files");
  for (std::size_t i = 0; i < count; ++i) {
    scene.files.push_back(tileset_in(file_name(paths[i])));
  }
  if (format != nullptr) scene.format = format;
  check_scene_format(scene.format, scene.files);
  return scene;
}

bp_scene_info info_of(const Scene& scene, Call& call) {
  SceneOptions options;
  const VoxelizeBudget budget(call.common().memory_bytes);
  options.memory_bytes = budget.reader;
  options.temp_dir = call.common().temp;
  options.keep_degenerate = true;
  options.document = document_budget(call.common().memory_bytes, kVoxelProgram, scene.files.size());
  const auto source = scene.open(options);
  Bounds3d bounds;
  for (std::vector<TriangleD> chunk; source->read(chunk);) {
    call.begin("reading");
    for (const TriangleD& t : chunk) {
      for (const Vec3d& p : t) bounds.add(p);
    }
  }
  const SceneCounts& c = source->counts();
  bp_scene_info info{0, c.triangles, c.degenerate, c.non_finite, c.bad_faces, {}, {}};
  std::copy(bounds.min.begin(), bounds.min.end(), info.min);
  std::copy(bounds.max.begin(), bounds.max.end(), info.max);
  return info;
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

void bp_arrays_defaults(bp_arrays* arrays, size_t size) {
  bp_arrays defaults{};
  defaults.vertex_type = BP_FLOAT64;
  defaults.triangle_type = BP_UINT32;
  put_defaults(arrays, size, defaults);
}

bp_status bp_scene_from_arrays(const bp_arrays* arrays, const char* name, bp_scene** out) {
  return guarded([&] {
    bp_scene*& made = needed(out, "the result");
    bp_arrays defaults{};
    defaults.triangle_type = BP_UINT32;
    auto scene = std::make_shared<Scene>();
    scene->name = name == nullptr ? "the scene" : name;
    scene->arrays.emplace(take_struct(&needed(arrays, "arrays"), defaults, "bp_arrays"));
    made = new bp_scene{std::move(scene)};
  });
}

bp_status bp_scene_from_files(const char* const* paths, size_t count, const char* format, bp_scene** out) {
  return guarded([&] {
    bp_scene*& made = needed(out, "the result");
    auto scene = std::make_shared<const Scene>(scene_of_files(paths, count, format));
    made = new bp_scene{std::move(scene)};
  });
}

bp_status bp_scene_read_info(const bp_scene* scene, const bp_run* run, bp_scene_info* info, size_t size) {
  return guarded_call(run, [&](Call& call) { put_struct(info, size, info_of(*needed(scene, "scene").scene, call)); });
}

void bp_scene_free(bp_scene* scene) {
  delete scene;
}

}  // extern "C"
