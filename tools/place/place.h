#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_options.h"
#include "lib/core/box.h"
#include "lib/place/placement.h"
#include "lib/place/scene_map.h"
#include "tools/cli/args.h"

/// The place of a tileset on the globe: options, and what follows from them and from the scene.
namespace bp {

struct PlaceOptions {
  std::optional<Vec3d> place;      ///< longitude, latitude, height
  Vec3d at{};                      ///< the scene's point that stands there, in the scene's axes
  std::string crs;                 ///< of the scene's coordinates; empty: they are no system's
  std::optional<UpAxis> scene_up;  ///< with a system: what --up says of the scene

  void add_to(Args& args);
  /// Checks the options after args.parse(). Throws bad_argument. With a system, --up (`up`) is about the scene, and the
  /// tileset has z up.
  void check(std::optional<UpAxis>& up, bool can_read_again);
};

struct PlacedScene {
  std::optional<Placement> placement;   ///< none: no place was asked for; `at` is in the scene's axes
  std::shared_ptr<const SceneMap> map;  ///< for SceneOptions::map; null: nothing moves
  std::vector<std::string> notes;
};

/// Returns the placement of a tileset of the scenes. With a system, reads the scenes once for their centre. The place
/// is then the centre's, rounded to a hundredth of a degree and at height 0: so most changes of a scene leave it alone.
/// Throws bad_input if the scene cannot lie in its system, or if PROJ has only a ballpark operation for it, and as
/// crs_operation().
[[nodiscard]] PlacedScene place_scene(const PlaceOptions& options, const std::vector<std::string>& scenes,
                                      const SceneOptions& reading);

/// Returns the map that a tileset's placement says its scene went through; null: none. Reads the scenes once. Throws as
/// crs_operation(), and `failed` if PROJ would take another operation here.
[[nodiscard]] std::shared_ptr<const SceneMap> map_of(const Placement& placement, const std::vector<std::string>& scenes,
                                                     const SceneOptions& reading);

/// Returns "52.01000 N, 4.36000 E, height 0.0 m".
[[nodiscard]] std::string place_text(const GlobePlace& place);

/// Returns a note about a scene with `up` and its placement, whose `at` is in the scene's axes; empty: there is nothing
/// to say. Without a placement, its coordinates may look like ECEF once z is up. With a place, a large scene leaves the
/// globe, as it is flat.
[[nodiscard]] std::string place_note(const Bounds3d& bounds, UpAxis up, const std::optional<Placement>& placement);

}  // namespace bp
