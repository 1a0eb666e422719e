#pragma once
#include "tools/lod/build_options.h"

namespace bp {

/// bplod --explain: prints the plan of a run, and writes it into the report, without running. The scene is read once,
/// for its bounds; with --cache it is voxelized, too, to find what is kept (look_up_tileset()).
void explain(const BuildOptions& options);

}  // namespace bp
