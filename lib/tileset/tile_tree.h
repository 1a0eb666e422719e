#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/grid/cells.h"
#include "lib/tileset/tileset.h"

namespace bp {

/// What the tree must know of a tile. Scene units; points of the lattice, so that differences are exact.
struct TreeTile {
  std::string uri;
  Vec3d origin{};   ///< that the vertices of its content are relative to
  Bounds3d bounds;  ///< of its content
  double error_world = 0;
};

/// A piece of the scene as it is, below a tile: for its cell, or for octants of it (a digit each: octant_of()).
struct TileLeaf {
  TreeTile tile;
  Bounds3d cell;
  std::string path;
};

/// Puts the tiles of all levels together: the root above, each tile above the eight cells that its own is made of; a
/// level in one mesh is a chain of its own on top. Where a cell has no tile, those below stand in its place: below a
/// content every tile draws something, or the scene has nothing there.
class TileTree {
 public:
  TileTree(UpAxis up, Cells cells) : up_(up), cells_(cells) {}

  /// A tile of level `level`, which is cut; `frame`: of the level. Levels come finest first.
  void add(std::size_t level, const GridFrame& frame, CellCoord cell, TreeTile tile);
  /// Below the tile of a cell of the finest level, which is there already if that level is cut. A tile of that level
  /// without any leaf gets one without content: the scene has nothing there, and close up nothing is drawn.
  void add_leaf(const GridFrame& frame, CellCoord cell, TileLeaf leaf);
  /// A level in one mesh, after all that are cut; coarser ones follow.
  void add_whole(TreeTile tile);

  /// diameter: of the scene; the error of drawing nothing at all. Errors rise towards the root, whatever was measured.
  [[nodiscard]] Tileset finish(double diameter);
  /// Largest error of the tiles of a level, those below them included; after finish().
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
  [[nodiscard]] Bounds3d local(const Bounds3d& bounds, const Vec3d& origin) const;
  [[nodiscard]] Vec3d z_up(const Vec3d& p) const;

  UpAxis up_;
  Cells cells_;
  Level level_;  ///< the last one that is cut, with all below
  std::size_t number_ = 0;
  GridFrame frame_;
  std::optional<Node> root_;
  std::vector<double> errors_;
  std::optional<double> leaf_error_;  ///< of leaves, if there are any
};

/// Octant k of a box: bit i of k says which half along axis i.
[[nodiscard]] Bounds3d octant_of(const Bounds3d& box, int k);
/// Bounds of a cell of a level, scene units.
[[nodiscard]] Bounds3d cell_bounds(const Cells& cells, const GridFrame& frame, CellCoord cell);

}  // namespace bp
