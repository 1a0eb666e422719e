#pragma once
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/grid/stream.h"
#include "lib/tileset/tileset.h"

/// tileset.json of 3D Tiles 1.1: reading and writing. Explicit tilesets with boxes; what else a tileset may hold is
/// left alone.
namespace bp {

/// Throws bad_input, with the place, if the file is missing, no JSON, or breaks the schema where it is looked at.
/// Implicit tiling and tilesets within tilesets are refused: they are not looked into.
/// What it says that may move, hide or cull and is not read goes into Tileset::not_understood. Throws out_of_resource
/// if it takes more than options.document: kTileBytes for each tile, and its JSON while it is read.
[[nodiscard]] Tileset read_tileset(const std::string& path, const SceneOptions& options = {});

/// The same of a tileset that is about to be replaced: it is none of the files that this process reads
/// (io/files/kept_files.h), and no memory is counted.
[[nodiscard]] Tileset read_old_tileset(const std::string& path);

constexpr std::uint64_t kTileBytes = 1400;  ///< of memory for a tile, while a tileset is checked

/// The text of an explicit tileset; the chain of tools goes into asset.extras, the cell of a tile into its extras. Same
/// tileset, same bytes.
[[nodiscard]] std::string tileset_text(const Tileset& tileset, const std::vector<Provenance>& provenance);

}  // namespace bp
