#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/check/tile_finding.h"
#include "lib/check/tile_part.h"
#include "lib/tileset/tileset.h"
#include "tools/cli/report.h"

namespace bp {

struct TilesetVerdict {
  std::vector<std::string> findings;  ///< one line each; empty: everything holds
  std::uint64_t tiles = 0, contents = 0, triangles = 0;
  std::uint64_t leaves = 0;     ///< contents that are leaves: pieces of the scene itself
  double tolerance = 0;         ///< how far the scene may be from its leaves: 3 * CoverReport::leaf_error
  std::uint64_t thin = 0;       ///< CoverReport::thin
  std::uint64_t flat = 0;       ///< CoverReport::flat
  std::uint64_t holes = 0;      ///< contents whose images may cut holes
  UpAxis up = UpAxis::z;        ///< up axis of the scene, as the tileset says
  bool scene = false;           ///< the contents were checked against scenes
  SceneCounts scene_counts;     ///< of these scenes
  std::uint64_t undecided = 0;  ///< findings that prove nothing, and refute nothing
  TilePart part;
  std::optional<Placement> placement;  ///< of the tileset
  void add(const std::vector<TileFinding>& found);
  [[nodiscard]] Answer answer() const {
    if (findings.size() > undecided) return Answer::refuted;
    return undecided > 0 || scene_counts.is_partial() ? Answer::undecided : Answer::proven;
  }
  [[nodiscard]] bool holds() const { return answer() == Answer::proven; }
  [[nodiscard]] std::string doubt() const;                        ///< why the answer is *not decided*
  [[nodiscard]] std::string text(const std::string& name) const;  ///< returns the findings, then one line of summary
  /// Returns {"number", "of"}; null for a whole check.
  [[nodiscard]] Json part_json() const;
  /// Returns one JSON object, indented. Its keys and their order are part of the interface.
  [[nodiscard]] std::string json(const std::string& name) const;
};

/// Returns the verdict on a tileset that was read from `path`: check_tileset() on it and on the contents that lie
/// beside it. With scenes, each content must also be a closed, embedded proxy that strictly encloses them
/// (check_proxy), wherever its transforms put it, and a viewer must draw some of them (check_drawn()). The scenes are
/// in their own axes; the tileset says which one is up. If the tileset's placement names a system, the scenes are taken
/// through it (map_of()); if that cannot be done here, they are not compared, and the answer is *not decided*. Throws
/// bad_input if a scene cannot be read, or if the scenes have no triangle with an area; a content that cannot be read
/// is a finding. options.map becomes that of the placement.
///
/// Contents are read when they are needed (twice if there are scenes), and take memory_bytes at a time, one content at
/// least. The scenes are read once for each such share (check_cover()), or once for each content if tiles have no
/// cells. Every part checks what the tileset itself says, and the contents of its own tiles (tiles_of()). So a finding
/// of one check is a finding of a part, and everything holds if all parts hold.
[[nodiscard]] TilesetVerdict check_tileset_file(const Tileset& tileset, const std::string& path,
                                                const std::vector<std::string>& scenes, SceneOptions& options,
                                                std::uint64_t memory_bytes, TilePart part = {});

[[nodiscard]] bool is_tileset(const std::string& path);  ///< its name ends in .json

}  // namespace bp
