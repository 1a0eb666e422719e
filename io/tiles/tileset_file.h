#pragma once
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/grid/stream.h"
#include "lib/tileset/tileset.h"

/// Reads and writes tileset.json of 3D Tiles 1.1: explicit tilesets with boxes. Other content of a tileset is ignored.
namespace bp {

/// Reads a tileset. Throws bad_input, with the place, if the file is missing, no JSON, or breaks the schema in the
/// parts that are read. Implicit tiling and tilesets within tilesets are refused. Content that may move, hide or cull
/// and is not read goes into Tileset::not_understood. Throws out_of_resource if the tileset takes more than
/// options.document: kTileBytes for each tile, and its JSON while it is read.
[[nodiscard]] Tileset read_tileset(const std::string& path, const SceneOptions& options = {});

/// Reads a tileset that will be replaced: it is not kept as an input (io/files/kept_files.h), and no memory is counted.
[[nodiscard]] Tileset read_old_tileset(const std::string& path);

constexpr std::uint64_t kTileBytes = 1400;  ///< memory for a tile while a tileset is checked

/// Returns the text of an explicit tileset. The chain of tools goes into asset.extras, the cell of a tile into its
/// extras. Same tileset, same bytes.
[[nodiscard]] std::string tileset_text(const Tileset& tileset, const std::vector<Provenance>& provenance);

}  // namespace bp
