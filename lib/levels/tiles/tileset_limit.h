#pragma once
#include "lib/levels/lod_level.h"
#include "lib/levels/tiles/cut_levels.h"

/// The memory of all steps of a tileset, which are counted when one of them is refused: the number that a refusal names
/// must suffice for the steps after it, too.
namespace bp {

/// The facts from which the steps of a tileset are counted.
struct TilesetCount {
  const TilesetPlan& plan;
  const CutOptions& cut;
  const LodOptions& whole;      ///< of the levels in one mesh; with `first`
  PassContext context;          ///< with all of the memory
  std::uint64_t held_bytes;     ///< that the scene's triangles take while levels are cut
  std::uint64_t triangles = 0;  ///< of the scene that levels enclose or follow
  /// Returns how many of them lie near a cell of a cut level; empty: nobody knows, and all may.
  std::function<std::uint64_t(std::size_t, CellCoord)> near{};
};

/// Returns the limit on memory at which level `level` fits, and each level after it. 0: not known. `solid` holds the
/// bricks of `header`: the voxels of that level. Meshes the surfaces of all these levels, brick by brick.
[[nodiscard]] std::uint64_t tileset_limit(const TilesetCount& count, const StreamHeader& header, BrickShelf& solid,
                                          std::size_t level = 0);

/// Returns the limit for all levels that a pyramid has still to make.
[[nodiscard]] std::uint64_t tileset_limit(const TilesetCount& count, TilePyramid& pyramid);

}  // namespace bp
