#pragma once
#include <vector>

#include "lib/check/tile_cover.h"

/// Does a viewer draw anything at all? A tile without content draws nothing, and a viewer that tolerates its error
/// stops there. A tile that is replaced leaves the scene to those below.
namespace bp {

/// For each tile whether one above it stays beside it and stands for the scene there: it has content, and is refined by
/// adding. Tiles below it may draw nothing.
[[nodiscard]] std::vector<bool> tiles_held_above(const std::vector<CoverTile>& tiles);

/// One finding for each place where nothing may be drawn of what the scene has there. `scene`: its bounds; `error`: of
/// the tileset, which is that of drawing nothing.
///   - The tileset's error is at least the scene's diagonal: so a viewer that draws nothing tolerates an error as large
///     as the scene. Below the longest side of the bounds this is refuted, from there on not decided.
///   - The same holds for each tile with children and without content, for what the scene has in its cell.
///   - Where no tile has a cell, so that every content must enclose all of the scene: a tile with content that is
///     replaced has one with content below it, and so on.
/// It looks at the tree alone, not at contents.
[[nodiscard]] std::vector<TileFinding> check_drawn(const std::vector<CoverTile>& tiles, double error,
                                                   const Bounds3d& scene);

}  // namespace bp
