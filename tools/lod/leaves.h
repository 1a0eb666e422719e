#pragma once
#include <map>
#include <string>
#include <vector>

#include "lib/store/result_store.h"
#include "lib/tileset/tile_tree.h"
#include "tools/lod/scene/lod_scene.h"

/// Makes leaves of a tileset from the scene's own triangles (--leaves scene).
namespace bp {

/// The leaves that a tileset needs, and where they go.
struct LeafTask {
  GridFrame frame;  ///< frame of the finest level
  const SceneLooks& looks;
  std::vector<CellCoord> cells;  ///< cells that may have leaves
  ResultStore* results = nullptr;
  Scratch* files = nullptr;  ///< where contents wait until they are written
};

/// A file that waits to be written.
struct WaitingFile {
  std::string name;
  Scratch::Handle content;
};

struct MadeLeaves {
  std::vector<WaitingFile> files;  ///< in the order of the cells
  std::vector<std::pair<CellCoord, TileLeaf>> places;
  /// Names of the image files that leaves use, with their numbers in the scene's TextureSet.
  std::map<std::string, std::uint32_t> images;
  std::uint64_t triangles = 0, bytes = 0, kept = 0;
};

/// Returns the folder of the leaves and their images.
[[nodiscard]] std::string leaf_folder(const BuildOptions& options);
/// Makes all leaves in parallel. Each leaf is a job of its own, whose result is kept. The scene's looks are in memory
/// in the meantime.
[[nodiscard]] MadeLeaves make_leaves(const Build& build, const LeafTask& task);

/// Returns the limit on memory at which make_leaves() has enough. 0: not known.
[[nodiscard]] std::uint64_t leaves_limit(const Build& build, const LeafTask& task);

}  // namespace bp
