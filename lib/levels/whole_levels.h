#pragma once
#include "lib/levels/level_chain.h"
#include "lib/pass/color/scene_colors.h"
#include "lib/store/result_store.h"

/// Makes the levels of a tileset that are one mesh each, together as one job.
namespace bp {

/// A level that is one mesh, as a file.
struct WholeLevel {
  std::string content;
  Bounds3d bounds;  ///< of its vertices
  LevelFacts facts;
  std::vector<Provenance> provenance;
};

struct WholeLevels {
  Vec3d origin{};  ///< all contents are relative to it
  std::vector<WholeLevel> levels;
  std::vector<LeftOut> left_out;
};

/// Everything that the levels are made from.
struct WholeInput {
  StreamHeader header;
  std::unique_ptr<BrickShelf> solid;
  /// `first`: number of the first level; the levels before it are cut. `count`: the most levels.
  std::size_t first = 0, count = 0;
  LevelRequest request;
  LodOptions lod;                 ///< with the surface (LodOptions::surface), and for a fit with the scene
  SceneColors* colors = nullptr;  ///< null: none
  /// Everything else that the contents depend on: names, options.
  std::string encoding;
};

/// Returns the key of everything that the levels depend on.
[[nodiscard]] ResultKey key_of(const WholeInput& input);
/// Returns the levels that were kept under a key; nothing if there are none.
[[nodiscard]] std::optional<WholeLevels> kept_levels(const ResultKey& key, ResultStore& store);
void keep_levels(const ResultKey& key, const WholeLevels& levels, ResultStore& store);

/// Returns a point that is a lattice point of every level, near the middle of all. No level may be empty.
[[nodiscard]] Vec3d common_origin(const std::vector<LodLevel>& levels);
/// Returns the box around the vertices of a mesh, scene units.
[[nodiscard]] Bounds3d bounds_of(const LatticeMesh& mesh);

}  // namespace bp
