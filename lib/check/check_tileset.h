#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lib/tileset/tileset.h"

/// What must hold of a tileset beyond its schema.
namespace bp {

/// Why a tile that its file calls a leaf cannot be one; empty: it can. A leaf encloses nothing, so a file's word is not
/// enough: it has no children, it lies below a tile that is proven, and it moves the scene by rounding only: by less
/// than that tile's error, and by 2^-22 of the edge of that tile's cell at most.
/// `above`: the nearest tile above that has content, or null.
[[nodiscard]] std::string leaf_fault(const Tile& leaf, const Tile* above);

/// What is known of the content of a tile.
struct TileContent {
  bool found = false;           ///< there, and readable
  std::string complaint;        ///< why not
  std::vector<Vec3d> vertices;  ///< in the space of its tile: glTF turned to z up
};
/// Reads the content of a tile that has a uri; each is asked for once, depth first, and gone before the next.
using TileContents = std::function<TileContent(const Tile&)>;

/// One finding per line, with the path of the tile ("root.children[0]"); empty if all holds:
///   - the version is 1.1; the root says how it refines; errors are finite and not negative;
///   - the tileset's error is at least the root's; no child's error is above its parent's;
///   - the corners of a child's box lie in its parent's box, and the content's vertices in its tile's box, each with
///     its transforms, but for 1e-9 of the box's size: transforms of doubles round;
///   - leaves have no leaf_fault();
///   - every content is there.
[[nodiscard]] std::vector<std::string> check_tileset(const Tileset& tileset, const TileContents& content_of);

}  // namespace bp
