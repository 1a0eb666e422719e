#pragma once
#include <string>
#include <vector>

#include "io/scene/raw_source.h"

/// The contents that show a tileset as fine as it is.
namespace bp {

struct CountedJson;

/// A file with a glTF, and where it stands.
struct ContentFile {
  std::string path;
  ContentPlace place;
};

struct TilesetContents {
  UpAxis up = UpAxis::z;  ///< of their space
  std::vector<ContentFile> files;
};

/// As open_tileset(), whose tileset's JSON is `json`.
///   path  of the tileset; other files lie beside it
[[nodiscard]] TilesetContents contents_of(const CountedJson& json, const std::string& path,
                                          const SceneOptions& options);

/// Their triangles, one file after the other. Throws as open_tileset().
[[nodiscard]] RawSourcePtr open_contents(TilesetContents contents, const SceneOptions& options);

}  // namespace bp
