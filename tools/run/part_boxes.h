#pragma once
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/core/box.h"
#include "lib/grid/stream.h"

namespace bp {

/// Boxes around the parts of a scene whose name fits (SceneOptions::parts): together they hold all of their triangles,
/// and each point of them is near one. At most some thousand; the finest are as large as a 256th of the scene's
/// diagonal. Memory: of the reader, and 4 MiB. Throws bad_input if the files are not there any more or not the same, if
/// their format has no names, or if no part fits. `options`: how the scene is read; its format and parts are those of
/// `scene` and `pattern`.
[[nodiscard]] std::vector<Bounds3d> part_boxes(const SceneFiles& scene, const Bounds3d& bounds,
                                               const std::string& pattern, SceneOptions options);

}  // namespace bp
