#pragma once
#include <functional>
#include <string>

#include "lib/grid/stream.h"

namespace bp {

/// Reads the triangles of a stream's scene again, all or those of parts whose name or material matches. Throws
/// bad_input if the stream names no file, or if one is not as it was.
void read_again(const SceneFiles& scene, const Bounds3d& bounds, const std::string& pattern,
                const std::function<void(const TriangleD&)>& take);

}  // namespace bp
