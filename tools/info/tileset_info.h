#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/tileset/tileset.h"
#include "tools/cli/report.h"

/// The facts that bpinfo prints about a tileset.json. Contents are counted and their sizes added up; they are not read.
/// bpcheck reads them.
namespace bp {

/// Tiles of one depth of the tree.
struct TileDepth {
  std::uint64_t tiles = 0, contents = 0, bytes = 0;
  double error_min = 0, error_max = 0;  ///< least and largest geometricError, metres
};

struct TilesetInfo {
  std::string version, up;
  double geometric_error = 0;        ///< geometricError of the tileset, metres
  std::vector<TileDepth> depths;     ///< the root first
  std::vector<std::string> missing;  ///< uris of contents that are no files in the tileset's folder
  /// Bounds of the root's box in the tileset's space, z up; none if the root has a sphere or region.
  std::optional<Bounds3d> bounds;
  std::optional<Placement> placement;   ///< on the globe
  std::vector<std::string> provenance;  ///< one line for each step
};

/// `path`: the file of the tileset; contents are looked for in its folder.
[[nodiscard]] TilesetInfo tileset_info(const Tileset& tileset, const std::string& path);

[[nodiscard]] std::string tileset_text(const TilesetInfo& info, const std::string& name);
[[nodiscard]] Json tileset_json(const TilesetInfo& info);

}  // namespace bp
