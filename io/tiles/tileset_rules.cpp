#include "io/tiles/tileset_rules.h"

#include "io/files/lower.h"
#include "io/files/uri.h"

namespace bp {

void check_tile(const GltfObject& tile, int depth) {
  constexpr int kMostDeep = 64;  // deeper ones are a mistake or an attack on the stack
  if (depth > kMostDeep) tile.broken(fmt::format("lies below {} tiles", kMostDeep));
  if (tile.has("implicitTiling") || tile.has_extension("3DTILES_implicit_tiling"))
    tile.unfit("is tiled implicitly, which is not read");
  if (tile.has_extension("3DTILES_multiple_contents")) tile.unfit("has contents in an extension, which are not read");
}

std::string content_uri(const GltfObject& content) {
  return detail::percent_decoded(content.text(content.has("uri") ? "uri" : "url"));
}

bool names_tileset(const std::string& uri) {
  return uri.ends_with(".json");
}

bool adds(const std::string& refine) {
  return lower(refine) == "add";
}

bool is_leaf(const GltfObject& tile) {
  return tile.has("extras") && tile.object("extras").has("leaf") && tile.object("extras").flag("leaf");
}

}  // namespace bp
