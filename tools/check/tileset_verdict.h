#pragma once
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/check/tile_finding.h"
#include "lib/check/tile_part.h"
#include "tools/cli/report.h"

namespace bp {

struct TilesetVerdict {
  std::vector<std::string> findings;  ///< one line each; empty: all holds
  std::uint64_t tiles = 0, contents = 0, triangles = 0;
  std::uint64_t leaves = 0;     ///< of the contents: pieces of the scene itself
  double tolerance = 0;         ///< how far the scene may be from its leaves: 3 * CoverReport::leaf_error
  std::uint64_t thin = 0;       ///< CoverReport::thin
  std::uint64_t flat = 0;       ///< CoverReport::flat
  std::uint64_t holes = 0;      ///< contents whose images may cut holes
  UpAxis up = UpAxis::z;        ///< of the scene, as the tileset says
  bool scene = false;           ///< the contents were checked against scenes
  SceneCounts scene_counts;     ///< of these
  std::uint64_t undecided = 0;  ///< of the findings: they prove nothing, and refute nothing
  TilePart part;
  void add(const std::vector<TileFinding>& found);
  [[nodiscard]] Answer answer() const {
    if (findings.size() > undecided) return Answer::refuted;
    return undecided > 0 || scene_counts.is_partial() ? Answer::undecided : Answer::proven;
  }
  [[nodiscard]] bool holds() const { return answer() == Answer::proven; }
  [[nodiscard]] std::string doubt() const;                        ///< why it is not decided
  [[nodiscard]] std::string text(const std::string& name) const;  ///< the findings, then one line of summary
  /// {"number", "of"}; null of a whole check.
  [[nodiscard]] Json part_json() const;
  /// One JSON object, indented. Keys and their order are part of the interface.
  [[nodiscard]] std::string json(const std::string& name) const;
};

/// What bpcheck says of a tileset.json: check_tileset() on it and the contents that lie beside it. With scenes:
/// besides, each content must be a closed, embedded proxy that strictly encloses them (check_proxy), wherever its
/// transforms put it, and a viewer must draw some of them (check_drawn()). `of_tileset`: for the tileset.json itself.
/// The scenes are in their own axes, the tileset says which one is up. Throws bad_input if the tileset or a scene
/// cannot be read, or if the scenes have no triangle with an area; a content that cannot is a finding. Contents are
/// read when they are needed, with scenes twice, and take memory_bytes at a time (one at least); the scenes are read
/// once for each share of them (check_cover()), or for each content where tiles have no cells. Every part checks what
/// the tileset itself says; the contents of its tiles are its own (tiles_of()), so that a finding of one check is one
/// of a part, and all holds if all parts hold.
[[nodiscard]] TilesetVerdict check_tileset_file(const std::string& path, const std::vector<std::string>& scenes,
                                                const SceneOptions& of_tileset, const SceneOptions& options,
                                                std::uint64_t memory_bytes, TilePart part = {});

[[nodiscard]] bool is_tileset(const std::string& path);  ///< by its name: *.json

}  // namespace bp
