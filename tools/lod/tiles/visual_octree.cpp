#include "tools/lod/tiles/visual_octree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/pass/leaf/scene_tiles.h"

namespace bp {

VisualOctree::VisualOctree(const LeafTree& tree, std::uint64_t most) : most_(most) {
  add(tree, 0);
}

std::size_t VisualOctree::add(const LeafTree& tree, std::size_t depth) {
  if (tree.octants.size() == 1) return add(tree.octants.front(), depth);  // a tile above one would be the same
  const std::size_t number = tiles_.size();
  tiles_.push_back({tree.box, depth});
  for (const LeafTree& octant : tree.octants) {
    const std::size_t below = add(octant, depth + 1);
    tiles_[number].below.push_back(below);
  }
  if (tree.octants.empty() && tree.box.triangles > most_) {  // it cannot be divided, but has fewer from afar
    constexpr char kWhole = '8';                             // after the digits of octants
    tiles_.push_back({tree.box, depth + 1});
    tiles_.back().box.path += kWhole;
    tiles_[number].below.push_back(tiles_.size() - 1);
  }
  return number;
}

std::size_t VisualOctree::depths() const {
  std::size_t most = 0;
  for (const VisualTile& tile : tiles_) most = std::max(most, tile.depth + 1);
  return most;
}

std::vector<std::size_t> VisualOctree::numbers_at(std::size_t depth) const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    if (tiles_[i].depth == depth) numbers.push_back(i);
  }
  return numbers;
}

std::uint64_t VisualOctree::expected_triangles(const VisualTile& tile) const {
  if (tile.below.empty()) return tile.box.triangles;
  std::uint64_t sum = 0;
  for (const std::size_t i : tile.below) sum += expected_triangles(tiles_[i]);
  return std::min(sum, most_);
}

/// `of`: returns the triangles of a tile below.
template <class Triangles>
std::uint64_t VisualOctree::bytes_of(const VisualTile& tile, const Triangles& of) const {
  if (tile.below.empty()) return tile.box.triangles * kLeafBytesPerTriangle;
  std::uint64_t triangles = 0;
  for (const std::size_t i : tile.below) triangles += of(tiles_[i]);
  return triangles * kTileBytesPerTriangle;
}

std::uint64_t VisualOctree::expected_bytes() const {
  std::uint64_t most = 0;
  for (const VisualTile& tile : tiles_)
    most = std::max(most, bytes_of(tile, [&](const VisualTile& below) { return expected_triangles(below); }));
  return most;
}

std::uint64_t VisualOctree::bytes_to_make(const VisualTile& tile) const {
  return bytes_of(tile, [](const VisualTile& below) { return below.triangles; });
}

std::vector<std::string> VisualOctree::notes(double unit, double longest_side) const {
  constexpr double kUnitsPerEdge = 64;  // the lattice is coarse where a mean edge has fewer units
  std::vector<std::string> all;
  std::uint64_t over = 0, largest = 0, leaves = 0;
  double area = 0;
  for (const VisualTile& tile : tiles_) {
    over += tile.triangles > most_;
    largest = std::max(largest, tile.triangles);
    if (tile.below.empty()) leaves += tile.triangles, area += tile.area;
  }
  if (over > 0)
    all.push_back(
        fmt::format("{} of {} tiles have more than {} triangles, {} at most: those that many large triangles meet, "
                    "or whose sides cut through much of the scene",
                    over, tiles_.size(), most_, largest));
  if (leaves > 0 && std::sqrt(area / double(leaves)) < kUnitsPerEdge * unit)
    all.push_back(fmt::format("vertices are rounded to {:.3g}, since the scene spans {:.4g}: is a part of it far away?",
                              unit, longest_side));
  return all;
}

std::vector<LevelRow> VisualOctree::rows(const std::string& folder) const {
  std::vector<LevelRow> rows(depths());
  std::vector<std::uint64_t> kept(rows.size());
  for (const VisualTile& tile : tiles_) {
    const std::size_t i = rows.size() - 1 - tile.depth;
    LevelRow& row = rows[i];
    kept[i] += tile.kept;
    if (tile.triangles == 0) continue;
    row.tiles += 1;
    row.faces += tile.triangles;
    row.bytes += tile.bytes;
    row.error_world = std::max(row.error_world, tile.error_world);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].file = fmt::format("{}/{}.glb", folder, std::string(rows.size() - i, '?'));
    rows[i].more = {{"kept", kept[i]}};
  }
  return rows;
}

}  // namespace bp
