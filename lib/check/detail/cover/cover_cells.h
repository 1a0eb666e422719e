#pragma once
#include <array>
#include <optional>
#include <vector>

#include "lib/check/cover_tile.h"
#include "lib/check/tile_finding.h"

/// Questions about a tileset that its tiles answer alone, before the scene is read.
namespace bp {

/// The tiles of a subtree that belong to this part of the check.
struct TileSubtree {
  std::size_t first = 0, last = 0;   ///< least and largest number of these; none: the first is above the last
  std::optional<double> leaf_error;  ///< the largest error, if the tiles below are only leaves
};

/// Returns the subtree of each tile, itself included. `mine`: whether a tile belongs to this part of the check.
[[nodiscard]] std::vector<TileSubtree> tile_subtrees(const std::vector<CoverTile>& tiles,
                                                     const std::vector<bool>& mine);

/// For each eighth of a tile's cell: the child that has it as its cell, or 0.
using TileOctants = std::array<std::uint32_t, 8>;
[[nodiscard]] TileOctants octants_of(const std::vector<CoverTile>& tiles, std::size_t tile);

/// Adds a finding for each child of the tile whose cell is not its alone, or is no octant of the tile's.
void check_cells(const std::vector<CoverTile>& tiles, std::size_t tile, std::vector<TileFinding>& findings);

}  // namespace bp
