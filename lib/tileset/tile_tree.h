#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/grid/cells.h"
#include "lib/tileset/tileset.h"

namespace bp {

/// The facts about a tile that the tree needs. Scene units; points of the lattice, so that differences are exact.
struct TreeTile {
  std::string uri;
  Vec3d origin{};   ///< the vertices of its content are relative to this point
  Bounds3d bounds;  ///< bounds of its content
  double error_world = 0;
};

/// A piece of the scene itself below a tile: for its cell, or for an octant of it (a digit for each level:
/// octant_of()).
struct TileLeaf {
  TreeTile tile;
  Bounds3d cell;
  std::string path;
};

/// Puts the tiles of all levels together: the root on top, each tile above the eight cells that make up its own. A
/// level in one mesh is a link of a chain on top. If a cell has no tile, the tiles below take its place: below a
/// content every tile draws something, or the scene has nothing there.
class TileTree {
 public:
  TileTree(UpAxis up, Cells cells) : up_(up), cells_(cells) {}

  /// Adds a tile of level `level`, which is cut; `frame` is that of the level. Levels come finest first.
  void add(std::size_t level, const GridFrame& frame, CellCoord cell, TreeTile tile);
  /// Adds a leaf below the tile of a cell of the finest level, which must be there already if that level is cut. A tile
  /// of that level without any leaf gets one without content: the scene has nothing there, and close up nothing is
  /// drawn.
  void add_leaf(const GridFrame& frame, CellCoord cell, TileLeaf leaf);
  /// Adds a level in one mesh, after all levels that are cut. Coarser ones follow.
  void add_whole(TreeTile tile);

  /// Finishes the tree. `diameter` of the scene is the error of drawing nothing. Errors rise towards the root, whatever
  /// was measured. `placement`: that of the tileset, with `at` in
  /// the scene's axes.
  [[nodiscard]] Tileset finish(double diameter, const std::optional<Placement>& placement = {});
  /// Returns the largest error of the tiles of a level, including those below them. Call it after finish().
  [[nodiscard]] double error_of(std::size_t level) const { return errors_.at(level); }

 private:
  struct Node {
    TreeTile tile;
    std::optional<Bounds3d> cell;  ///< empty if no level is cut into tiles
    std::vector<Node> children;
    bool is_leaf = false;
  };
  using Level = std::map<CellCoord, Node>;

  void raise();
  [[nodiscard]] static std::vector<const Node*> nodes_below(const Node& node);
  [[nodiscard]] Tile tile_of(const Node& node, const Vec3d& parent, double above) const;

  UpAxis up_;
  Cells cells_;
  Level level_;  ///< the last level that is cut, with all levels below
  std::size_t number_ = 0;
  GridFrame frame_;
  std::optional<Node> root_;
  std::vector<double> errors_;
  std::optional<double> leaf_error_;  ///< of leaves, if there are any
};

/// Returns a tile of this content: its place below a tile whose vertices are relative to `parent`, in 3D Tiles' axes.
[[nodiscard]] Tile tile_at(const TreeTile& tile, const Vec3d& parent, UpAxis up);

/// Returns the tileset of a root. `up`: axis of the scene; `diameter` and `placement`: as in TileTree::finish().
[[nodiscard]] Tileset tileset_of(Tile root, double diameter, UpAxis up, const std::optional<Placement>& placement);

[[nodiscard]] Vec3d middle_of(const Bounds3d& box);
/// Returns octant k of a box: bit i of k chooses the half along axis i.
[[nodiscard]] Bounds3d octant_of(const Bounds3d& box, int k);
/// Returns the bounds of a cell of a level, scene units.
[[nodiscard]] Bounds3d cell_bounds(const Cells& cells, const GridFrame& frame, CellCoord cell);

}  // namespace bp
