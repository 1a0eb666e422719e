#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "tools/api/array_scene.h"

namespace bp::api {

/// A scene of arrays, or of files that are opened when they are needed.
struct Scene {
  std::string name;                  ///< of arrays, for messages
  std::optional<ArrayScene> arrays;  ///< else files
  std::vector<std::string> files;
  std::string format;  ///< of files whose names do not tell it

  /// Opens it from its start. Throws as open_scenes() does. The result keeps a reference to this object.
  [[nodiscard]] std::unique_ptr<TriangleSource> open(const SceneOptions& options) const;
};

}  // namespace bp::api

struct bp_scene {
  std::shared_ptr<const bp::api::Scene> scene;
};
