#pragma once
#include "tools/lod/build_options.h"
#include "tools/lod/level_list.h"

namespace bp {

/// bplod --profile 3dtiles. Levels that are larger than a cell are cut into tiles, each a job of its own; from the
/// first one that is not on, levels are made whole. With --tiles only those jobs are done, and their results kept.
void build_tileset(const BuildOptions& options);

/// What is kept of the jobs of a tileset in --cache: of each level that is cut, then of the
/// levels in one mesh, which are one job. The scene is voxelized, and closings that are not kept are made; nothing is
/// written. `kept` is exact; so is `jobs` if all are kept, else a cavity may be counted as a tile.
[[nodiscard]] std::vector<FoundJobs> look_up_tileset(const BuildOptions& options);

}  // namespace bp
