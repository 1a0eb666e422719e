#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/grid/stream.h"

namespace bp {

[[nodiscard]] std::vector<std::string> names_of(const SceneFiles& scene);

/// A reason why the files that a stream names are surely not what it was made from.
struct SceneFault {
  std::string fact;      ///< "scene.obj is not there"
  bool changed = false;  ///< the file exists, but has changed
};
[[nodiscard]] std::optional<SceneFault> fault_of(const SceneFiles& scene);
/// Returns the fault of a file that has changed.
[[nodiscard]] SceneFault changed_scene(const std::string& file);

}  // namespace bp
