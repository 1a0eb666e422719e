#pragma once
#include <string>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/tileset/tileset.h"

/// tileset.json of 3D Tiles 1.1: reading and writing. Explicit tilesets with boxes; what else a tileset may hold is
/// left alone.
namespace bp {

/// Throws bad_input, with the place, if the file is missing, no JSON, or breaks the schema where it is looked at.
/// Implicit tiling and tilesets within tilesets are refused: they are not looked into.
[[nodiscard]] Tileset read_tileset(const std::string& path);

/// The text of an explicit tileset; the chain of tools goes into asset.extras, the cell of a tile into its extras. Same
/// tileset, same bytes.
[[nodiscard]] std::string tileset_text(const Tileset& tileset, const std::vector<Provenance>& provenance);

}  // namespace bp
