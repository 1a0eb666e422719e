#pragma once
#include "tools/lod/build_options.h"
#include "tools/lod/level_list.h"

namespace bp {

/// Makes a tileset (bplod --profile 3dtiles). Levels that are larger than a cell are cut into tiles, each a job of its
/// own; the first level that is not, and all after it, are one mesh each. With --tiles only the named jobs are done,
/// and their results kept.
void build_tileset(const BuildOptions& options);

/// Counts the results of a tileset that are kept in --cache: for each cut level, then for the levels that are one mesh
/// each, which are one job together. The scene is voxelized, and closings that are not kept are made; nothing is
/// written. `kept` is exact. `jobs` is exact if all are kept; else it may count a cavity as a tile.
[[nodiscard]] std::vector<FoundJobs> look_up_tileset(const BuildOptions& options);

}  // namespace bp
