#pragma once
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/core/box.h"
#include "lib/grid/stream.h"

namespace bp {

/// Returns boxes around the parts of a scene whose name fits (SceneOptions::parts): together they hold all triangles of
/// the parts, and each point of a box is near a triangle. At most some thousand boxes; the smallest are as large as a
/// 256th of the scene's diagonal. Memory: that of the reader, and 4 MiB. Throws bad_input if the files are missing or
/// have changed, if their format has no names, or if no part fits. `options`: how the scene is read; `scene` and
/// `pattern` replace its format and parts.
[[nodiscard]] std::vector<Bounds3d> part_boxes(const SceneFiles& scene, const Bounds3d& bounds,
                                               const std::string& pattern, SceneOptions options);

}  // namespace bp
