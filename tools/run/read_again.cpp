#include "tools/run/read_again.h"

#include <filesystem>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"

namespace bp {

namespace {

void check_files(const SceneFiles& scene) {
  if (scene.files.empty())
    fail(ErrorCode::bad_input, "the stream names no scene file, and its parts are not known; give bpvox a file");
  for (const SceneFiles::File& file : scene.files) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file.name, none)) fail(ErrorCode::bad_input, "{}: is not there", file.name);
    if (std::filesystem::file_size(file.name, none) != file.bytes)
      fail(ErrorCode::bad_input, "{}: has changed since the stream was made; run bpvox again", file.name);
  }
}

/// Else what takes it might cut it into parts without an end.
void check_within(const TriangleD& t, const Bounds3d& bounds, const std::string& name) {
  for (const Vec3d& p : t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(p[i] >= bounds.min[i] && p[i] <= bounds.max[i]))
        fail(ErrorCode::bad_input, "{}: has changed since the stream was made; run bpvox again", name);
    }
  }
}

}  // namespace

void read_again(const SceneFiles& scene, const Bounds3d& bounds, const std::string& pattern,
                const std::function<void(const TriangleD&)>& take) {
  check_files(scene);
  std::vector<std::string> names;
  for (const SceneFiles::File& file : scene.files) names.push_back(file.name);
  SceneOptions options;
  options.format = scene.format;
  options.parts = pattern;
  const auto source = open_scenes(names, options);
  for (std::vector<TriangleD> chunk; source->read(chunk);) {
    for (const TriangleD& t : chunk) {
      check_within(t, bounds, source->name());
      take(t);
    }
  }
}

}  // namespace bp
