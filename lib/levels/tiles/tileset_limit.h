#pragma once
#include "lib/levels/lod_level.h"
#include "lib/levels/tiles/tile_pyramid.h"

/// The memory of all steps of a tileset, which are counted when one of them is refused: the number that a refusal names
/// must suffice for the steps after it, too.
namespace bp {

/// The facts from which the steps of a tileset are counted.
struct TilesetCount {
  const TilesetPlan& plan;
  const CutOptions& cut;
  const LodOptions& whole;         ///< of the levels in one mesh; with `first`
  PassContext context;             ///< with all of the memory
  std::uint64_t held_bytes;        ///< that the scene's triangles take while levels are cut
  std::uint64_t triangles = 0;     ///< of the scene that levels enclose or follow
  std::vector<CellCounts> near{};  ///< for each cut level, those near each cell; empty: all may be near any cell
};

/// Counts a triangle for each cell of the level that it is near to, by its bounds.
void add_near(const CutLevel& level, const Cells& cells, const Bounds3d& triangle, CellCounts& counts);

/// Returns the limit on memory at which level `level` fits, and each level after it. 0: not known. `solid` holds the
/// bricks of `header`: the voxels of that level. Meshes the surfaces of all these levels, brick by brick.
[[nodiscard]] std::uint64_t tileset_limit(const TilesetCount& count, const StreamHeader& header, BrickShelf& solid,
                                          std::size_t level = 0);

/// Returns the limit for all levels that a pyramid has still to make.
[[nodiscard]] std::uint64_t tileset_limit(const TilesetCount& count, TilePyramid& pyramid);

}  // namespace bp
