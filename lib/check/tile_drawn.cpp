#include "lib/check/tile_drawn.h"

#include <fmt/format.h>

#include <algorithm>

namespace bp {

namespace {

bool has_content(const CoverTile& tile) {
  return !tile.uri.empty();
}

Bounds3d within(Bounds3d bounds, const std::optional<Bounds3d>& cell) {
  if (!cell) return bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    bounds.min[k] = std::max(bounds.min[k], cell->min[k]);
    bounds.max[k] = std::min(bounds.max[k], cell->max[k]);
    if (bounds.min[k] > bounds.max[k]) return {};
  }
  return bounds;
}

/// Decides whether drawing nothing is an error of at most `error`.
Answer is_within(double error, const Bounds3d& bounds) {
  if (bounds.empty() || error >= bounds.diagonal()) return Answer::proven;
  return error < bounds.longest_side() ? Answer::refuted : Answer::undecided;
}

/// Returns for each tile whether all tiles that a viewer may draw in its place have a content.
std::vector<bool> tiles_that_draw(const std::vector<CoverTile>& tiles) {
  std::vector<bool> draws(tiles.size());
  for (std::size_t i = tiles.size(); i-- > 0;) {
    const CoverTile& tile = tiles[i];
    const bool below = std::any_of(tile.children.begin(), tile.children.end(), [&](std::size_t c) { return draws[c]; });
    draws[i] = below || (has_content(tile) && (tile.adds || tile.children.empty()));
  }
  return draws;
}

}  // namespace

std::vector<bool> tiles_held_above(const std::vector<CoverTile>& tiles) {
  std::vector<bool> held(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const bool holds = held[i] || (tiles[i].adds && has_content(tiles[i]) && !tiles[i].leaf_error);
    for (const std::size_t child : tiles[i].children) held[child] = holds;
  }
  return held;
}

std::vector<TileFinding> check_drawn(const std::vector<CoverTile>& tiles, double error, const Bounds3d& scene) {
  std::vector<TileFinding> findings;
  if (const Answer answer = is_within(error, scene); answer != Answer::proven) {
    findings.push_back({fmt::format("tileset: geometricError {} is below the size of the scene, {:.6g}, and where a "
                                    "viewer tolerates more it draws nothing",
                                    error, scene.diagonal()),
                        answer});
  }
  const std::vector<bool> held = tiles_held_above(tiles), draws = tiles_that_draw(tiles);
  const bool cells =
      std::any_of(tiles.begin(), tiles.end(), [](const CoverTile& tile) { return tile.cell.has_value(); });
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const CoverTile& tile = tiles[i];
    if (held[i] || tile.is_joint || tile.children.empty()) continue;
    if (!cells && has_content(tile) && !draws[i])
      findings.push_back({fmt::format("{}: {} gives way to tiles that draw nothing", tile.place, tile.uri)});
    if (has_content(tile)) continue;
    const Bounds3d here = within(scene, tile.cell);
    if (const Answer answer = is_within(tile.error, here); answer != Answer::proven) {
      findings.push_back(
          {fmt::format("{}: draws nothing, and geometricError {} is below the size of what the scene has "
                       "there, {:.6g}, so that a viewer may stop at it",
                       tile.place, tile.error, here.diagonal()),
           answer});
    }
  }
  return findings;
}

}  // namespace bp
