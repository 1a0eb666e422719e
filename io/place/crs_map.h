#pragma once
#include <memory>
#include <string>

#include "lib/place/globe.h"
#include "lib/place/placement.h"
#include "lib/place/scene_map.h"

/// Coordinate reference systems, by PROJ. Without PROJ at build time all functions throw `failed`.
namespace bp {

/// A way from a coordinate reference system to ECEF coordinates (EPSG:4978).
struct CrsOperation {
  std::string name;          ///< PROJ's name for it
  double accuracy = -1;      ///< metres; negative: PROJ does not know
  bool is_ballpark = false;  ///< PROJ leaves out a change of datum or of heights, as it lacks a grid or parameters
  bool has_heights = true;   ///< false: heights are taken as they are for heights above the ellipsoid
  std::string outside;       ///< area for which the system is meant, if the sample lies outside
  GlobePlace sample;         ///< place of the sample
};

/// Returns the operation that PROJ finds best for `sample`, a point of the scene: x east, y north, z up; ECEF: as it
/// is. All points of a scene take the same one. Throws bad_argument if PROJ does not know the system, or if its
/// coordinates are degrees; bad_input if the sample cannot be transformed.
[[nodiscard]] CrsOperation crs_operation(const std::string& crs, const Vec3d& sample);

/// Returns the map of a scene in `placement.crs` to metres to the east, to the north and up from `placement.place`.
/// Each point is transformed by PROJ. Throws as crs_operation().
[[nodiscard]] std::shared_ptr<const SceneMap> crs_map(const Placement& placement, const Vec3d& sample);

}  // namespace bp
