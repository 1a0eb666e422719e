#pragma once
#include <memory>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"

namespace bp {

/// Opens several files, as open_scenes() reads them.
[[nodiscard]] std::unique_ptr<TriangleSource> scene_row(std::vector<std::string> paths, const SceneOptions& options);

}  // namespace bp
