#pragma once
#include <functional>
#include <vector>

#include "io/scene/scene_file.h"
#include "lib/core/coords.h"

namespace bp {

/// Reads the vertices of an OBJ file ahead of its faces, on all cores. Calls take() with them, in the order of the
/// file. Returns false if a line is not as nearly all programs write it (a continued line, a lone CR, a number that a
/// plain one is not): take() then got the vertices of the lines before some line, and none of them is wrong. Takes 1
/// MiB for each thread.
[[nodiscard]] bool read_plain_vertices(const SceneFile& file,
                                       const std::function<void(const std::vector<Vec3d>&)>& take);

}  // namespace bp
