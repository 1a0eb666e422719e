#pragma once
#include <string>

#include "lib/core/box.h"
#include "lib/grid/stream.h"

namespace bp {

/// Returns boxes around the parts of a scene whose name fits (SceneOptions::parts), one box for parts that stand
/// together: a line each, `{"name": "wheel*", "box": [[0,0,0],[1,2,3]]}`, as in rules of bpscale. Two parts stand
/// together if less than a 256th of the scene's diagonal is between them. Throws as part_boxes().
[[nodiscard]] std::string part_places(const SceneFiles& scene, const Bounds3d& bounds, const std::string& pattern);

}  // namespace bp
