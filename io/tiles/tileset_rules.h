#pragma once
#include <string>

#include "io/gltf/gltf_document.h"

/// What every reader of a tileset's JSON asks of it. Fields of version 1.0 are taken, too.
namespace bp {

/// Throws bad_input for a tile that lies too deep, and for one that draws more than its tileset lists: implicit tiling,
/// and contents in an extension.
void check_tile(const GltfObject& tile, int depth);
/// Of a content: decoded.
[[nodiscard]] std::string content_uri(const GltfObject& content);
/// True if a content is a tileset of its own.
[[nodiscard]] bool names_tileset(const std::string& uri);
/// How a tile is refined that says `refine`: its content stays beside those below.
[[nodiscard]] bool adds(const std::string& refine);
/// Its content is a piece of the scene itself; ours only (extras.leaf).
[[nodiscard]] bool is_leaf(const GltfObject& tile);

}  // namespace bp
