#pragma once
#include "lib/store/result_store.h"
#include "tools/lod/build.h"

namespace bp {

/// A level of a tileset in one mesh, as a file.
struct WholeLevel {
  std::string content;
  Bounds3d bounds;
  LevelRow row;
  std::vector<Provenance> provenance;
};

struct WholeLevels {
  Vec3d origin{};  ///< that all contents are relative to
  std::vector<WholeLevel> levels;
  bool kept = false;  ///< found in the store
};

/// What they are made from.
struct WholeInput {
  StreamHeader header;
  std::unique_ptr<BrickShelf> solid, surface;  ///< surface: as in LodOptions
  std::size_t first = 0, count = 0;            ///< levels, at most; those below are cut
  double scene_voxel = 0;
  std::string input_hash;  ///< of the scene, for the provenance; empty: it is not to depend on all of the scene
};

/// Whether `store` has them.
[[nodiscard]] bool are_kept(const Build& build, const WholeInput& input, const LodOptions& lod, ResultStore& store);

/// The levels that are not cut, as one job: from `store`, if it is not null and has them, else made, and put there.
[[nodiscard]] WholeLevels make_whole_levels(Build& build, WholeInput input, LodOptions lod, ResultStore* store);

}  // namespace bp
