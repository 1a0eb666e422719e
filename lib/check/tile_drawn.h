#pragma once
#include <vector>

#include "lib/check/cover_tile.h"
#include "lib/check/tile_finding.h"

/// Decides whether a viewer draws anything at all. A tile without content draws nothing, and a viewer that tolerates
/// its error stops there. A tile that is replaced leaves the scene to the tiles below.
namespace bp {

/// Returns for each tile whether a tile above it shows the scene there in any case: it has content, and is refined by
/// adding. Tiles below it may draw nothing.
[[nodiscard]] std::vector<bool> tiles_held_above(const std::vector<CoverTile>& tiles);

/// Returns one finding for each place where the scene has something and nothing may be drawn. `scene`: its bounds;
/// `error`: the tileset's, which is the error of drawing nothing.
///   - The tileset's error must be at least the scene's diagonal, so that only a viewer that tolerates an error as
///     large as the scene draws nothing. Below the longest side of the bounds this is refuted, from there on not
///     decided.
///   - The same must hold for each tile with children and without content, for the part of the scene in its cell.
///   - If no tile has a cell, so that every content must enclose the whole scene: a tile with content that is replaced
///     must have one with content below it, and so on. Only the tree is tested, not the contents.
[[nodiscard]] std::vector<TileFinding> check_drawn(const std::vector<CoverTile>& tiles, double error,
                                                   const Bounds3d& scene);

}  // namespace bp
