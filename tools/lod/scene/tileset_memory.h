#pragma once
#include <vector>

#include "lib/levels/tiles/tileset_limit.h"
#include "tools/lod/scene/lod_scene.h"

/// The memory of a tileset: a refusal names a limit at which all of its steps fit.
namespace bp {

/// Returns what so many triangles of a scene take while tiles are made around them, bytes.
[[nodiscard]] std::uint64_t bytes_beside_tiles(std::uint64_t triangles);

/// Counts the limit on memory at which all steps of a tileset fit, its leaves included.
class TilesetMemory {
 public:
  /// The inputs of a tileset.
  struct Parts {
    const Build& build;
    const LodScene& scene;
    const TilesetPlan& plan;
    const SceneLooks* looks;  ///< of the leaves; null: there are none
    CutOptions cut;
    double share = 1;  ///< of the memory for work
  };
  /// Keeps references. The scene has its voxels.
  explicit TilesetMemory(Parts parts);

  /// Returns the limit for all levels. `whole`: of the levels in one mesh. `solid`: of the scene.
  [[nodiscard]] std::uint64_t operator()(const LodOptions& whole, BrickShelf& solid) const;
  /// Returns the limit for the levels that a pyramid has still to make.
  [[nodiscard]] std::uint64_t operator()(const LodOptions& whole, TilePyramid& pyramid) const;

 private:
  [[nodiscard]] TilesetCount count(const LodOptions& whole) const;
  [[nodiscard]] std::uint64_t of_looks() const;

  const Parts parts_;
  std::vector<CellCoord> leaf_cells_;  // that may have leaves
};

}  // namespace bp
