#include "tools/run/scene_files.h"

#include <filesystem>

namespace bp {

std::vector<std::string> names_of(const SceneFiles& scene) {
  std::vector<std::string> names;
  for (const SceneFiles::File& file : scene.files) names.push_back(file.name);
  return names;
}

SceneFault changed_scene(const std::string& file) {
  return {file + " has changed since the stream was made", true};
}

std::optional<SceneFault> fault_of(const SceneFiles& scene) {
  if (scene.files.empty()) return SceneFault{"the stream names no scene file"};
  for (const SceneFiles::File& file : scene.files) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file.name, none)) return SceneFault{file.name + " is not there"};
    if (std::filesystem::file_size(file.name, none) != file.bytes) return changed_scene(file.name);
  }
  return std::nullopt;
}

}  // namespace bp
