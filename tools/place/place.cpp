#include "tools/place/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/place/crs_map.h"
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_totals.h"

namespace bp {

namespace {

Vec3d middle_of(const Bounds3d& bounds) {
  return bounds.min + 0.5 * (bounds.max - bounds.min);
}

/// Returns the centre of the scenes with z up.
Vec3d centre_of(const std::vector<std::string>& scenes, SceneOptions reading, std::optional<UpAxis> up) {
  reading.map = nullptr;
  reading.colors = false;
  reading.textures = nullptr;
  const auto source = open_scenes(scenes, reading);
  const Bounds3d bounds = bounds_of(*source);
  if (bounds.empty()) fail(ErrorCode::bad_input, "{}: no triangles; a scene needs at least one", source->name());
  return turned(middle_of(bounds), up.value_or(source->up().value_or(UpAxis::z)), UpAxis::z);
}

double rounded(double degrees) {
  constexpr double kPerDegree = 100;  // some kilometres: the frame tilts by less than 0.0001 over a city
  return std::round(degrees * kPerDegree) / kPerDegree + 0.0;  // no -0
}

std::vector<std::string> notes_of(const std::string& crs, const CrsOperation& operation) {
  std::vector<std::string> notes;
  const std::string accuracy = operation.accuracy < 0    ? "of unknown accuracy"
                               : operation.accuracy == 0 ? "which is exact"
                                                         : fmt::format("accurate to {:.3g} m", operation.accuracy);
  notes.push_back(fmt::format("{}: PROJ takes \"{}\", {}", crs, operation.name, accuracy));
  if (!operation.has_heights)
    notes.push_back(
        fmt::format("{} has no heights: those of the scene are taken for metres above the ellipsoid WGS 84", crs));
  if (!operation.outside.empty())
    notes.push_back(fmt::format("the scene lies at {}, outside of the area of {} ({}): is this its system, and --up?",
                                place_text(operation.sample), crs, operation.outside));
  return notes;
}

}  // namespace

void PlaceOptions::add_to(Args& args) {
  args.option("--place", "LON,LAT,HEIGHT", place, "where 0,0,0, or --origin X,Y,Z, stands on WGS 84; x points east");
  args.option("--crs", "CRS", crs, "the scene's reference system, as EPSG:28992; PROJ places each vertex");
}

void PlaceOptions::check(std::optional<UpAxis>& up, bool can_read_again) {
  if (place) {
    const auto [lon, lat, height] = *place;
    if (!crs.empty()) fail(ErrorCode::bad_argument, "--place and --crs exclude each other: a system knows its places");
    if (!(std::abs(lat) <= 90) || !(std::abs(lon) <= 360) || !(std::abs(height) <= 1e5))
      fail(ErrorCode::bad_argument,
           "--place {},{},{}: must be a longitude and a latitude in degrees, and a height in metres", lon, lat, height);
  }
  if (crs.empty()) return;
  if (!can_read_again)
    fail(ErrorCode::bad_argument, "--crs: a scene from a pipe cannot be read again; give it as a file");
  scene_up = up;
  up = UpAxis::z;
}

PlacedScene place_scene(const PlaceOptions& options, const std::vector<std::string>& scenes,
                        const SceneOptions& reading) {
  PlacedScene placed;
  if (options.place) {
    const auto [lon, lat, height] = *options.place;
    placed.placement.emplace().place = {lon, lat, height};
    placed.placement->at = options.at;
  }
  if (options.crs.empty()) return placed;
  constexpr double kMostHeight = 2e4;
  const Vec3d centre = centre_of(scenes, reading, options.scene_up);
  const CrsOperation operation = crs_operation(options.crs, centre);
  if (operation.is_ballpark)
    fail(ErrorCode::bad_input,
         "--crs {}: PROJ lacks grids or parameters for it, and the scene would stand some hundred metres off; get "
         "its grids with projsync, or name another system, as one without heights",
         options.crs);
  const GlobePlace& at = operation.sample;
  if (std::abs(at.height) > kMostHeight)
    fail(ErrorCode::bad_input,
         "--crs {}: the scene would lie at {}; say with --up which of its axes is up, or another "
         "system",
         options.crs, place_text(at));
  Placement& placement = placed.placement.emplace();
  placement.place = {rounded(at.lon), rounded(at.lat), 0};
  placement.crs = options.crs, placement.operation = operation.name, placement.scene_up = options.scene_up;
  placed.map = crs_map(placement, centre);
  placed.notes = notes_of(options.crs, operation);
  return placed;
}

std::shared_ptr<const SceneMap> map_of(const Placement& placement, const std::vector<std::string>& scenes,
                                       const SceneOptions& reading) {
  if (placement.crs.empty()) return nullptr;
  const Vec3d centre = centre_of(scenes, reading, placement.scene_up);
  const CrsOperation operation = crs_operation(placement.crs, centre);
  if (operation.name != placement.operation)
    fail(ErrorCode::failed, "{}: PROJ takes \"{}\" here, and the tileset was made with \"{}\"", placement.crs,
         operation.name, placement.operation);
  return crs_map(placement, centre);
}

std::string place_text(const GlobePlace& place) {
  return fmt::format("{:.5f} {}, {:.5f} {}, height {:.1f} m", std::abs(place.lat), place.lat < 0 ? "S" : "N",
                     std::abs(place.lon), place.lon < 0 ? "W" : "E", place.height);
}

std::string place_note(const Bounds3d& bounds, UpAxis up, const std::optional<Placement>& placement) {
  Bounds3d upright;
  for (const Vec3d& p : {bounds.min, bounds.max}) upright.add(turned(p, up, UpAxis::z));
  if (!placement && looks_like_ecef(upright))
    return fmt::format(
        "the coordinates look like ECEF, and the tileset stands where they say: {}; with --crs EPSG:4978 its tiles "
        "would be upright there",
        place_text(globe_place(middle_of(upright))));
  if (!placement || !placement->crs.empty()) return "";
  constexpr double kRadius = 6371000, kMostFall = 1;  // metres
  const Vec3d at = turned(placement->at, up, UpAxis::z);
  double square = 0;  // of the largest distance from the place
  for (std::size_t i = 0; i < 2; ++i) {
    const double most = std::max(std::abs(upright.min[i] - at[i]), std::abs(upright.max[i] - at[i]));
    square += most * most;
  }
  const double fall = square / (2 * kRadius);
  if (!(fall > kMostFall)) return "";
  return fmt::format(
      "the scene reaches {:.1f} km from its point {},{},{}, which stands at the place: the globe falls {:.0f} m below "
      "it "
      "there; --origin names another point of the scene, and --crs follows the globe",
      std::sqrt(square) / 1000, placement->at[0], placement->at[1], placement->at[2], fall);
}

}  // namespace bp
