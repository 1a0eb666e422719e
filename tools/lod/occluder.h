#pragma once
#include "lib/levels/occluder_level.h"
#include "lib/pass/hide/entered_rooms.h"
#include "tools/lod/scene/lod_scene.h"

/// bplod --profile occluder.
namespace bp {

/// The body that enters, and its way into filled rooms.
struct EnteredRooms {
  double body_world = 0;  ///< height of the body; 0: none
  Entrance entrance;      ///< into filled rooms
};

/// An occluder, with the scene that it was made from.
struct BuiltOccluder {
  LodScene scene;
  HiddenScene hidden;
  EnteredRooms rooms;
  bool ground = false;  ///< the scene stands on the ground
  MadeOccluder made;
};
/// Makes the occluder of the options' scene, with its provenance, and tells its notes.
[[nodiscard]] BuiltOccluder built_occluder(Build& build);

/// Makes the occluder and writes its file.
void build_occluder(const BuildOptions& options);

}  // namespace bp
