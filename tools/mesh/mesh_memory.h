#pragma once
#include "lib/meshing/piece_store.h"
#include "tools/common/common_options.h"

namespace bp {

/// Of --memory, what bpmesh has for surfaces.
[[nodiscard]] PieceMemory mesh_memory(const CommonOptions& common);

}  // namespace bp
