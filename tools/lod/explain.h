#pragma once
#include "tools/lod/build_options.h"

namespace bp {

/// Prints the plan of a run (bplod --explain) and writes it into the report, without making anything. The scene is read
/// once, for its bounds; with --cache it is also voxelized, to find which results are kept (look_up_tileset()).
void explain(const BuildOptions& options);

/// Returns the first line of a plan: the scene's triangles and bounds.
[[nodiscard]] std::string scene_text(std::uint64_t triangles, const Bounds3d& bounds);

}  // namespace bp
