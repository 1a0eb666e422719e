#pragma once
#include <optional>

#include "lib/levels/detail/level_scene.h"

namespace bp {

/// Returns whether a level of the target may be simplified from a finer mesh. That holds for bounding levels that are
/// no cage and ask for a number of faces alone, 32 or more.
[[nodiscard]] bool may_follow(const LevelScene& scene, const LodTarget& target);
/// Returns whether the level may be simplified from this start: it has 50 faces for each part and hole of the start.
[[nodiscard]] bool follows_from(const LevelScene& scene, const LodTarget& target, const LevelStart& start);

/// Returns the parameters that all meshes of a level share. has_triangles: whether the scene's triangles are known
/// (LevelScene).
[[nodiscard]] MeshParams params_of_level(const LodOptions& options, const LodTarget& target, bool has_triangles);

/// Makes one level: proposes several meshes to BestLevel, and returns the best (LodChain::make). Several levels of one
/// scene may be made at the same time. The memory of `context` is for this level alone. `start`: the mesh to simplify;
/// null: none. `left` receives the mesh halfway to the level, from which coarser levels may be simplified; it stays
/// empty if there is none. Null: no level follows. Throws as close_stream() and mesh_stream().
[[nodiscard]] LodLevel searched_level(LevelScene& scene, const PassContext& context, const LodTarget& target,
                                      const LevelStart* start, std::optional<LevelStart>* left = nullptr);

}  // namespace bp
