#pragma once
#include "tools/lod/build.h"

/// What --profile occluder makes: one mesh that lies strictly within what the scene hides from every eye outside
/// (lib/stage/hidden_stage.h).
namespace bp {

struct MadeOccluder {
  VoxelizedScene scene;
  LodLevel level;              ///< scale_world: at which openings were closed; error_world: NaN, not measured
  Json more = Json::object();  ///< for the report
};

/// Without --scale, openings are closed at the least scale, up to a sixteenth of the scene's diagonal, that hides 0.95
/// of what the best one does. Parts narrower than some scale are left out where the faces show more without them: of
/// openings of 0, 2, 4... voxels the one that gives most volume within the budget. Throws bad_input if the scene hides
/// nothing.
[[nodiscard]] MadeOccluder make_occluder(Build& build);

}  // namespace bp
