#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/tileset/tileset.h"

/// One level of a tileset as a scene: what a viewer draws that refines every tile equally far.
namespace bp {

/// A content, and where it stands in the tileset's space.
struct PlacedContent {
  std::string path;
  Transform transform = kNoTransform;
};

struct TilesetLevel {
  std::size_t levels = 0;               ///< of the tileset: depths of its tree at which there are contents
  std::vector<PlacedContent> contents;  ///< depth first
  std::vector<std::string> missing;     ///< contents that are no files beside the tileset; uris
};

/// Level 0 is the finest. The tiles of level n lie n depths above the deepest, of those at which there are contents;
/// where a branch ends before, its last tile stands for it, and where a tile there has no content, those below it.
/// Tiles that are refined by adding keep theirs. Leaves (Tile::is_leaf) are no level. Empty if the tileset has no such
/// level.
[[nodiscard]] TilesetLevel tileset_level(const Tileset& tileset, const std::string& path, std::size_t level);

/// Their triangles in the axes of the scene (Tileset::up). One content is read at a time, each pass anew; throws as
/// open_scene() then.
[[nodiscard]] std::unique_ptr<TriangleSource> open_contents(const Tileset& tileset, std::vector<PlacedContent> contents,
                                                            const std::string& path, const SceneOptions& options);

}  // namespace bp
