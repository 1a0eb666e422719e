#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/tileset/tileset.h"
#include "tools/cli/report.h"

/// What bpinfo says of a tileset.json. Contents are counted and weighed, not read: bpcheck does that.
namespace bp {

/// Tiles of one depth of the tree.
struct TileDepth {
  std::uint64_t tiles = 0, contents = 0, bytes = 0;
  double error_min = 0, error_max = 0;  ///< geometricError, metres
};

struct TilesetInfo {
  std::string version, up;
  double geometric_error = 0;        ///< of the tileset, metres
  std::vector<TileDepth> depths;     ///< the root first
  std::vector<std::string> missing;  ///< contents that are no files beside the tileset; uris
  std::optional<Bounds3d> bounds;  ///< of the root's box in the tileset's space, z up; none: it has a sphere or region
  std::vector<std::string> provenance;  ///< a line each step
};

/// path: that it was read from; what lies beside it is looked for.
[[nodiscard]] TilesetInfo tileset_info(const Tileset& tileset, const std::string& path);

[[nodiscard]] std::string tileset_text(const TilesetInfo& info, const std::string& name);
[[nodiscard]] Json tileset_json(const TilesetInfo& info);

}  // namespace bp
