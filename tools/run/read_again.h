#pragma once
#include <functional>

#include "io/scene/scene_reader.h"
#include "lib/grid/stream.h"

namespace bp {

/// Reads the triangles of a stream's scene again. Throws bad_input if the stream names no file, or if a file has
/// changed. The scene's format replaces that of `options`.
void read_again(const SceneFiles& scene, const Bounds3d& bounds, SceneOptions options,
                const std::function<void(const TriangleD&)>& take);

}  // namespace bp
