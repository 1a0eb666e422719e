#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/tileset/tileset.h"

/// One level of a tileset as a scene: the tiles that a viewer draws if it refines every branch equally far.
namespace bp {

/// A content, and its place in the tileset's space.
struct PlacedContent {
  std::string path;
  Transform transform = kNoTransform;
};

struct TilesetLevel {
  std::size_t levels = 0;               ///< levels of the tileset: depths of its tree with contents
  std::vector<PlacedContent> contents;  ///< depth first
  std::vector<std::string> missing;     ///< uris of contents that are no files in the tileset's folder
};

/// Returns the contents of a level; level 0 is the finest. The tiles of level n lie n depths above the deepest,
/// counting depths with contents. A branch that ends before is represented by its last tile, and a tile without content
/// by those below it. Tiles that are refined by adding keep their content. Leaves (Tile::is_leaf) are no level. Empty
/// if the tileset has no such level.
[[nodiscard]] TilesetLevel tileset_level(const Tileset& tileset, const std::string& path, std::size_t level);

/// Opens the triangles of contents in the axes of the scene (Tileset::up). One content is read at a time, each pass
/// anew; reading throws as open_scene().
[[nodiscard]] std::unique_ptr<TriangleSource> open_contents(const Tileset& tileset, std::vector<PlacedContent> contents,
                                                            const std::string& path, const SceneOptions& options);

}  // namespace bp
