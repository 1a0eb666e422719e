#pragma once
#include <map>
#include <string>
#include <vector>

#include "lib/store/result_store.h"
#include "lib/tileset/tile_tree.h"
#include "tools/lod/scene/lod_scene.h"

/// The scene's own triangles as leaves of a tileset (--leaves scene).
namespace bp {

/// What the leaves of a tileset are, and go to.
struct LeafTask {
  GridFrame frame;  ///< of the finest level
  const SceneLooks& looks;
  std::vector<CellCoord> cells;  ///< that may have leaves
  ResultStore* results = nullptr;
  Scratch* files = nullptr;  ///< where contents wait
};

struct LeafFile {
  std::string name;
  Scratch::Handle content;
};

struct MadeLeaves {
  std::vector<LeafFile> files;  ///< in the order of the cells
  std::vector<std::pair<CellCoord, TileLeaf>> places;
  std::map<std::string, std::uint32_t> images;  ///< files that they show: numbers in the scene's TextureSet
  std::uint64_t triangles = 0, bytes = 0, kept = 0;
};

/// Folder of the leaves and their images.
[[nodiscard]] std::string leaf_folder(const BuildOptions& options);
/// In parallel; each leaf is a job of its own, whose result is kept. Held looks are in memory meanwhile.
[[nodiscard]] MadeLeaves make_leaves(const Build& build, const LeafTask& task);

/// Returns the limit on memory at which make_leaves() has enough. 0: not known.
[[nodiscard]] std::uint64_t leaves_limit(const Build& build, const LeafTask& task);

}  // namespace bp
