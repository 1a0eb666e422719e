#pragma once
#include <string>

#include "lib/core/triangle_source.h"

namespace bp {

/// Of a scene without triangles: throws bad_input, and tells what was skipped.
[[noreturn]] void refuse_empty_scene(const std::string& name, const SceneCounts& counts);

}  // namespace bp
