#pragma once
#include "lib/levels/occluder_level.h"
#include "tools/lod/scene/lod_scene.h"

/// bplod --profile occluder.
namespace bp {

/// An occluder, with the scene that it was made from.
struct BuiltOccluder {
  LodScene scene;
  HiddenScene hidden;
  bool ground = false;  ///< the scene stands on the ground
  MadeOccluder made;
};
/// Makes the occluder of the options' scene, with its provenance, and tells its notes.
[[nodiscard]] BuiltOccluder built_occluder(Build& build);

/// Makes the occluder and writes its file.
void build_occluder(const BuildOptions& options);

}  // namespace bp
