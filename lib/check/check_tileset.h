#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lib/check/tile_finding.h"
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
  bool found = false;                       ///< there, and readable
  std::string complaint;                    ///< why not
  Answer answer = Answer::refuted;          ///< what that means: undecided if a viewer may show it all the same
  std::vector<Vec3d> vertices;              ///< in the space of its tile: turned to z up
  std::vector<std::string> not_understood;  ///< what it says that may move or hide and is not read
};
/// Reads the content of a tile that has a uri; each is asked for once, depth first, and gone before the next.
using TileContents = std::function<TileContent(const Tile&)>;

/// One finding per line, with the path of the tile ("root.children[0]"); empty if all holds:
///   - the version is 1.0 or 1.1 (else not decided); the root says how it refines; errors are finite and not negative;
///   - something has content, and an error of 0 keeps no viewer from what lies below a tile without content;
///   - the tileset's error is at least the root's; no child's error is above its parent's. Errors are scaled as the
///     transforms scale lengths;
///   - a child's volumes lie in its parent's, and the content's vertices in its tile's volumes and its own, exactly
///     (tile_volumes.h). A sphere whose tile is sheared or scaled unevenly is not decided: viewers differ;
///   - leaves have no leaf_fault();
///   - every content is there;
///   - what is not understood is not decided.
[[nodiscard]] std::vector<TileFinding> check_tileset(const Tileset& tileset, const TileContents& content_of);

}  // namespace bp
