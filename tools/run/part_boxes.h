#pragma once
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/grid/stream.h"

namespace bp {

/// Boxes around the parts of a scene whose name fits (SceneOptions::parts): together they hold all of their triangles,
/// and each point of them is near one. At most some thousand; the finest are as large as a 256th of the scene's
/// diagonal. Memory: of the boxes. Throws bad_input if the files are not there any more or not the same, if their
/// format has no names, or if no part fits.
[[nodiscard]] std::vector<Bounds3d> part_boxes(const SceneFiles& scene, const Bounds3d& bounds,
                                               const std::string& pattern);

}  // namespace bp
