#pragma once
#include "tools/lod/build.h"

/// What --profile occluder makes: one mesh that lies strictly within what the scene hides from every eye outside
/// (lib/pass/hide/hidden_stage.h).
namespace bp {

struct MadeOccluder {
  VoxelizedScene scene;        ///< without its voxels
  LodLevel level;              ///< scale_world: at which openings were closed; error_world: NaN, not measured
  Json more = Json::object();  ///< for the report
};

/// Without --scale, openings are closed at the least scale, up to a sixteenth of the scene's diagonal, that hides 0.95
/// of what the best one does. A scene that hides a quarter more if it stands on the ground does so (not from stdin):
/// many buildings have no floor. Without --faces there are 100, or 24 for each part where that is more, at most 2400.
/// Where the faces show more without small and narrow parts, these are left out. Throws bad_input if the scene hides
/// nothing.
[[nodiscard]] MadeOccluder make_occluder(Build& build);

}  // namespace bp
