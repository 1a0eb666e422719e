#include "lib/check/detail/cover/cover_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/tileset/tile_tree.h"

namespace bp {

namespace {

constexpr std::size_t kSame = 8, kNowhere = 9, kPlaces = 10;

/// Returns the octant of a tile that a child has as its cell; kSame: the whole cell.
std::size_t place_in(const CoverTile& parent, const CoverTile& child) {
  if (parent.cell == child.cell) return kSame;
  for (int k = 0; parent.cell && child.cell && k < 8; ++k) {
    if (octant_of(*parent.cell, k) == *child.cell) return std::size_t(k);
  }
  return kNowhere;
}

}  // namespace

std::vector<TileSubtree> tile_subtrees(const std::vector<CoverTile>& tiles, const std::vector<bool>& mine) {
  std::vector<TileSubtree> below(tiles.size());
  for (std::size_t i = tiles.size(); i-- > 0;) {  // children follow their parents
    TileSubtree& all = below[i] = {mine[i] ? i : SIZE_MAX, mine[i] ? i : 0, 0.0};
    for (const std::size_t child : tiles[i].children) {
      const TileSubtree& some = below[child];
      all.first = std::min(all.first, some.first), all.last = std::max(all.last, some.last);
      const bool is_leaf = tiles[child].leaf_error.has_value();
      if (!some.leaf_error || (tiles[child].triangles && !is_leaf)) all.leaf_error.reset();
      if (all.leaf_error)
        all.leaf_error = std::max({*all.leaf_error, *some.leaf_error, tiles[child].leaf_error.value_or(0)});
    }
  }
  return below;
}

TileOctants octants_of(const std::vector<CoverTile>& tiles, std::size_t tile) {
  TileOctants out{};
  if (!tiles[tile].cell) return out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Bounds3d box = octant_of(*tiles[tile].cell, int(k));
    for (const std::size_t child : tiles[tile].children) {
      if (tiles[child].cell == box) out[k] = std::uint32_t(child);
    }
  }
  return out;
}

void check_cells(const std::vector<CoverTile>& tiles, std::size_t tile, std::vector<TileFinding>& findings) {
  const std::vector<std::size_t>& children = tiles[tile].children;
  std::array<std::uint64_t, kPlaces> at{};
  for (const std::size_t child : children) ++at[place_in(tiles[tile], tiles[child])];
  for (const std::size_t child : children) {
    const std::size_t place = place_in(tiles[tile], tiles[child]);
    if (place == kNowhere || (place == kSame && children.size() > 1))
      findings.push_back({fmt::format("{}: its cell is neither its parent's nor an octant of it", tiles[child].place)});
    if (place != kNowhere && at[place] > 1)
      findings.push_back({fmt::format("{}: another child of its parent has the same cell", tiles[child].place)});
  }
}

}  // namespace bp
