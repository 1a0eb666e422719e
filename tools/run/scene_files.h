#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/grid/stream.h"

namespace bp {

[[nodiscard]] std::vector<std::string> names_of(const SceneFiles& scene);

/// Why the files that a stream names are surely not what it was made from.
struct SceneFault {
  std::string fact;      ///< "scene.obj is not there"
  bool changed = false;  ///< the file is there, and another one
};
[[nodiscard]] std::optional<SceneFault> fault_of(const SceneFiles& scene);
/// The same, when it is known.
[[nodiscard]] SceneFault changed_scene(const std::string& file);

}  // namespace bp
