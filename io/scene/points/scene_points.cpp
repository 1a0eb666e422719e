#include "io/scene/points/scene_points.h"

#include "io/scene/raw_source.h"
#include "io/scene/scene_format.h"
#include "lib/core/error.h"

namespace bp {

void ScenePoints::write_frames(std::size_t, double, const MoveFrame&, OutputFile& out) {
  fail(ErrorCode::bad_input, "{}: only glTF keeps several frames in one file", out.name());
}

std::unique_ptr<ScenePoints> open_points(const std::string& path, const SceneOptions& options) {
  const std::string format = scene_format_of(path);
  if (format != "obj" && format != "ply" && format != "gltf" && format != "glb")
    fail(ErrorCode::bad_input, "{}: vertices are moved in OBJ, PLY and glTF; convert the scene to one of them", path);
  SceneFilePtr file = open_scene_file(path, temp_dir_of(options));
  if (format == "gltf" || format == "glb") return gltf_points(std::move(file), options);
  return format == "obj" ? obj_points(std::move(file)) : ply_points(std::move(file));
}

std::uint64_t bytes_of_points(const std::string& path, const SceneOptions& options, const PointsUse& use) {
  const std::string format = scene_format_of(path);
  if (format != "gltf" && format != "glb") return 0;
  return bytes_of_gltf_points(open_scene_file(path, temp_dir_of(options)), options, use);
}

}  // namespace bp
