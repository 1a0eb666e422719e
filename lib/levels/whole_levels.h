#pragma once
#include "lib/levels/level_chain.h"
#include "lib/pass/color/scene_colors.h"
#include "lib/store/result_store.h"

/// The levels of a tileset that are not cut, as one job.
namespace bp {

/// A level in one mesh, as a file.
struct WholeLevel {
  std::string content;
  Bounds3d bounds;  ///< of its vertices
  LevelFacts facts;
  std::vector<Provenance> provenance;
};

struct WholeLevels {
  Vec3d origin{};  ///< that all contents are relative to
  std::vector<WholeLevel> levels;
  std::vector<LeftOut> left_out;
};

/// What they are made from.
struct WholeInput {
  StreamHeader header;
  std::unique_ptr<BrickShelf> solid;
  std::size_t first = 0, count = 0;  ///< levels, at most; those below are cut
  LevelRequest request;
  LodOptions lod;                 ///< with the surface (LodOptions::surface), and the scene of a fit
  SceneColors* colors = nullptr;  ///< null: none
  /// Everything else that the contents depend on: names, options.
  std::string encoding;
};

/// Makes the key of everything that the levels depend on.
[[nodiscard]] ResultKey key_of(const WholeInput& input);
/// What was kept under a key; nothing if it is not there.
[[nodiscard]] std::optional<WholeLevels> kept_levels(const ResultKey& key, ResultStore& store);
void keep_levels(const ResultKey& key, const WholeLevels& levels, ResultStore& store);

/// A point that is a lattice point of every level, near the middle of all. Levels are not empty.
[[nodiscard]] Vec3d common_origin(const std::vector<LodLevel>& levels);
/// Around the vertices of a mesh.
[[nodiscard]] Bounds3d bounds_of(const LatticeMesh& mesh);

}  // namespace bp
