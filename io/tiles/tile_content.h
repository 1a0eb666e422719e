#pragma once
#include <string>
#include <vector>

#include "io/scene/raw_source.h"

/// The content of a tile: glTF, or a b3dm around one. The only way to it, for scenes and for proofs.
namespace bp {

struct TileContentFile {
  RawSourcePtr triangles;
  UnreadParts unread;  ///< RawSource::unread(), and what a b3dm says besides
};

/// `place`: of the tile. RTC_CENTER and CESIUM_RTC move it from there. Throws bad_input; Unfit if viewers may show
/// it, and it is of a kind that is not read.
[[nodiscard]] TileContentFile open_tile_content(const SceneFilePtr& file, const SceneOptions& options,
                                                const ContentPlace& place);

/// What a proof asks of a content.
struct TileMesh {
  IndexedMesh mesh;
  SceneCounts counts;
  UnreadParts unread;
};
/// The whole, as read_mesh(). Throws as open_tile_content().
[[nodiscard]] TileMesh read_tile_content(const std::string& path, const SceneOptions& options,
                                         const ContentPlace& place);

}  // namespace bp
