#pragma once
#include <functional>

#include "io/scene/scene_reader.h"
#include "lib/grid/stream.h"

namespace bp {

/// Reads the triangles of a stream's scene again. Throws bad_input if the stream names no file, or if one is not as it
/// was. The format of `options` is that of the scene.
void read_again(const SceneFiles& scene, const Bounds3d& bounds, SceneOptions options,
                const std::function<void(const TriangleD&)>& take);

}  // namespace bp
