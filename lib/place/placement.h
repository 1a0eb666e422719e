#pragma once
#include <optional>
#include <string>

#include "lib/core/up_axis.h"
#include "lib/place/globe.h"

namespace bp {

/// Where a tileset stands on the globe. Its own coordinates are metres to the east, to the north and up.
struct Placement {
  GlobePlace place;  ///< of the point `at`
  Vec3d at{};        ///< in the tileset's own coordinates
  /// The scene's coordinate reference system, as PROJ names it. Empty: the scene's own coordinates are those of the
  /// tileset. Otherwise each vertex of the scene was transformed (SceneMap).
  std::string crs;
  std::string operation;           ///< PROJ's name for that transformation
  std::optional<UpAxis> scene_up;  ///< up in the scene before the transformation, if the user said so
  /// Only of a tileset that was read: how far its root's transform takes a point of its volume from where `place` has
  /// it, at most; metres. It is what a viewer uses, and `place` is what the tileset says.
  double off = 0;
};

/// Returns the matrix from the tileset's own coordinates to ECEF coordinates.
[[nodiscard]] inline GlobeMatrix to_ecef(const Placement& placement) {
  GlobeMatrix m = east_north_up(placement.place);
  const Vec3d& p = placement.at;
  for (std::size_t i = 0; i < 3; ++i) m[12 + i] -= m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2];
  return m;
}

constexpr double kPlacedToWithin = 1e-3;  ///< metres; Placement::off is at most this

}  // namespace bp
