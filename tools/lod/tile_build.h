#pragma once
#include "tools/lod/build_options.h"

namespace bp {

/// bplod --profile 3dtiles. Levels that are larger than a cell are cut into tiles, each a job of its own; from the
/// first one that is not on, levels are made whole.
void build_tileset(const BuildOptions& options);

}  // namespace bp
