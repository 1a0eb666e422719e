#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lib/check/tile_finding.h"
#include "lib/tileset/tileset.h"

/// Checks the rules for a tileset that its schema cannot express.
namespace bp {

/// Returns why a tile that its file calls a leaf cannot be one; empty if it can. A leaf encloses nothing, so the file's
/// word is not enough. A leaf must have no children, and must lie below a tile that is proven. It may move the scene
/// only by rounding: by less than that tile's error, and by at most 2^-22 of the edge of that tile's cell. `above`: the
/// nearest tile above that has content, or null.
[[nodiscard]] std::string leaf_fault(const Tile& leaf, const Tile* above);

/// The facts about the content of a tile.
struct TileContent {
  bool found = false;     ///< it exists and can be read
  std::string complaint;  ///< why it cannot be read
  /// The answer for a content that cannot be read: undecided if a viewer may still show it.
  Answer answer = Answer::refuted;
  std::vector<Vec3d> vertices;              ///< in the space of its tile: turned to z up
  std::vector<std::string> not_understood;  ///< its parts that may move or hide it and are not read
};
/// Reads the content of a tile that has a uri. Each content is asked for once, depth first, and freed before the next.
using TileContents = std::function<TileContent(const Tile&)>;

/// Returns one finding per line, with the path of the tile ("root.children[0]"); empty if all these rules hold:
///   - the version is 1.0 or 1.1 (else not decided); the root says how it refines; errors are finite and not negative;
///   - some tile has content, and no error of 0 keeps viewers from the tiles below a tile without content;
///   - the tileset's error is at least the root's; no child's error is above its parent's. Errors are scaled as the
///     transforms scale lengths;
///   - a child's volumes lie in its parent's, and the content's vertices in its tile's volumes and its own, exactly
///     (tile_volumes.h). A sphere whose tile is sheared or scaled unevenly is not decided: viewers differ;
///   - leaves have no leaf_fault();
///   - if the tileset says where it stands, the root's transform takes it there, to within a millimetre;
///   - every content exists;
///   - keys that are not understood are not decided.
[[nodiscard]] std::vector<TileFinding> check_tileset(const Tileset& tileset, const TileContents& content_of);

}  // namespace bp
