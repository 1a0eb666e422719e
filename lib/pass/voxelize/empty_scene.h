#pragma once
#include <string>

#include "lib/core/triangle_source.h"

namespace bp {

/// Throws bad_input for a scene without triangles, and tells what was skipped.
[[noreturn]] void refuse_empty_scene(const std::string& name, const SceneCounts& counts);

}  // namespace bp
