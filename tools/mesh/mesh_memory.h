#pragma once
#include "lib/surface/piece_store.h"
#include "tools/cli/common_options.h"

namespace bp {

/// Returns the part of --memory that bpmesh has for surfaces.
[[nodiscard]] PieceMemory mesh_memory(const CommonOptions& common);

}  // namespace bp
