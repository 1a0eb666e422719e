#pragma once
#include <string>
#include <vector>

#include "io/scene/raw_source.h"

/// Reads the content of a tile: glTF, or a b3dm around one. Scenes and proofs both use it.
namespace bp {

struct TileContentFile {
  RawSourcePtr triangles;
  UnreadParts unread;  ///< RawSource::unread(), and content of the b3dm around it
};

/// Opens a content. `place`: the tile's. RTC_CENTER and CESIUM_RTC move the content from there. Throws bad_input; Unfit
/// if it is of a kind that viewers may show and that is not read.
[[nodiscard]] TileContentFile open_tile_content(const SceneFilePtr& file, const SceneOptions& options,
                                                const ContentPlace& place);

/// A content as proofs need it.
struct TileMesh {
  IndexedMesh mesh;
  SceneCounts counts;
  UnreadParts unread;
};
/// Reads a whole content, as read_mesh(). Throws as open_tile_content().
[[nodiscard]] TileMesh read_tile_content(const std::string& path, const SceneOptions& options,
                                         const ContentPlace& place);

}  // namespace bp
