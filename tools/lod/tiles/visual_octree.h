#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "lib/pass/leaf/scene_leaf.h"
#include "lib/store/result_key.h"
#include "lib/store/scratch.h"
#include "tools/lod/level_list.h"

/// The octree of visual tiles: what is known of each tile before it is made, and after.
namespace bp {

struct VisualTile {
  LeafBox box;
  std::size_t depth = 0;
  std::vector<std::size_t> below{};  ///< numbers of the tiles of its octants
  ResultKey key{};                   ///< of its result; set if results are kept
  // The members below are set when the tile is made. After that, a tile of 0 triangles is left out.
  Scratch::Handle tile = 0;     ///< the SceneTile, until the tile above is made
  Scratch::Handle content = 0;  ///< the file
  std::uint64_t triangles = 0, bytes = 0;
  double error_world = 0, area = 0;  ///< area: of leaves only
  Bounds3d bounds{};                 ///< of the tile and those below it
  bool kept = false;
};

class VisualOctree {
 public:
  /// `most`: the most triangles of a tile.
  VisualOctree(const LeafTree& tree, std::uint64_t most);
  [[nodiscard]] VisualTile& at(std::size_t i) { return tiles_[i]; }
  [[nodiscard]] const std::vector<VisualTile>& tiles() const { return tiles_; }  ///< each before those below it
  [[nodiscard]] const VisualTile& root() const { return tiles_.front(); }
  [[nodiscard]] std::size_t depths() const;
  [[nodiscard]] std::vector<std::size_t> numbers_at(std::size_t depth) const;
  /// Returns the memory that the largest tile is expected to take while it is made. The expected triangles are those
  /// that meet the box of a tile without tiles below; of another tile, the sum of those below, at most `most`, which it
  /// may exceed if much of the tile lies on the faces of its box.
  [[nodiscard]] std::uint64_t expected_bytes() const;
  /// Returns the memory that a tile takes while it is made. The tiles below are made.
  [[nodiscard]] std::uint64_t bytes_to_make(const VisualTile& tile) const;

  /// Returns notes on the tiles that were made. `unit`: the step of the lattice, scene units.
  [[nodiscard]] std::vector<std::string> notes(double unit, double longest_side) const;
  /// Returns a row for each depth, the deepest first. `folder`: the folder of the contents.
  [[nodiscard]] std::vector<LevelRow> rows(const std::string& folder) const;

 private:
  std::size_t add(const LeafTree& tree, std::size_t depth);
  [[nodiscard]] std::uint64_t expected_triangles(const VisualTile& tile) const;
  template <class Triangles>
  std::uint64_t bytes_of(const VisualTile& tile, const Triangles& of) const;

  std::vector<VisualTile> tiles_;
  std::uint64_t most_;
};

}  // namespace bp
