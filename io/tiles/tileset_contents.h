#pragma once
#include <string>
#include <vector>

#include "io/scene/raw_source.h"

/// The contents that show a tileset at its finest.
namespace bp {

struct CountedJson;

/// A file with a glTF, and its place.
struct ContentFile {
  std::string path;
  ContentPlace place;
};

struct TilesetContents {
  UpAxis up = UpAxis::z;  ///< axis that is up in the contents' space
  std::vector<ContentFile> files;
};

/// Returns the contents of a tileset whose JSON is `json`; as open_tileset().
///   path  the tileset's; other files lie in its folder
[[nodiscard]] TilesetContents contents_of(const CountedJson& json, const std::string& path,
                                          const SceneOptions& options);

/// Opens the triangles of all contents, one file after the other. Throws as open_tileset().
[[nodiscard]] RawSourcePtr open_contents(TilesetContents contents, const SceneOptions& options);

}  // namespace bp
