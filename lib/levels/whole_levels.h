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
  bool kept = false;  ///< found in the store
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

/// The file of level `number`. Vertices are relative to `origin`.
using WholeEncoder = std::function<std::string(std::size_t number, const LatticeMesh& mesh, const Vec3d& origin)>;

/// Whether `store` has them.
[[nodiscard]] bool are_kept(const WholeInput& input, ResultStore& store);

/// From `store`, if it is not null and has them; else made, and put there. steps.complete() sets provenance; colours
/// are there.
[[nodiscard]] WholeLevels make_whole_levels(WholeInput input, Backends& backends, const LevelSteps& steps,
                                            const WholeEncoder& encode, ResultStore* store);

}  // namespace bp
