#include "lib/place/globe.h"

#include <cmath>
#include <numbers>

namespace bp {

namespace {

constexpr double kA = 6378137, kF = 1 / 298.257223563, kE2 = kF * (2 - kF);  // NIMA TR8350.2, table 3.1
constexpr double kDegree = std::numbers::pi / 180;

/// Returns the distance from the ellipsoid's axis point to the ellipsoid, along the normal.
double normal_radius(double sin_lat) {
  return kA / std::sqrt(1 - kE2 * sin_lat * sin_lat);
}

}  // namespace

Vec3d ecef_of(const GlobePlace& place) {
  const double lon = place.lon * kDegree, lat = place.lat * kDegree, n = normal_radius(std::sin(lat));
  const double r = (n + place.height) * std::cos(lat);
  return {r * std::cos(lon), r * std::sin(lon), (n * (1 - kE2) + place.height) * std::sin(lat)};
}

GlobePlace globe_place(const Vec3d& p) {
  constexpr int kSteps = 12;  // each leaves at most 1/148 of the error
  const double r = std::hypot(p[0], p[1]);
  double lat = std::atan2(p[2], r * (1 - kE2));
  for (int i = 0; i < kSteps; ++i) lat = std::atan2(p[2] + kE2 * normal_radius(std::sin(lat)) * std::sin(lat), r);
  const double s = std::sin(lat), c = std::cos(lat), n = normal_radius(s);
  // The distance along the normal; no division by a cosine, which is 0 at the poles.
  const double height = r * c + p[2] * s - n * (1 - kE2 * s * s);
  return {std::atan2(p[1], p[0]) / kDegree, lat / kDegree, height};
}

GlobeMatrix east_north_up(const GlobePlace& place) {
  const double lon = place.lon * kDegree, lat = place.lat * kDegree;
  const double cos_lon = std::cos(lon), sin_lon = std::sin(lon), cos_lat = std::cos(lat), sin_lat = std::sin(lat);
  const Vec3d at = ecef_of(place);
  return {-sin_lon,
          cos_lon,
          0,
          0,  //
          -sin_lat * cos_lon,
          -sin_lat * sin_lon,
          cos_lat,
          0,  //
          cos_lat * cos_lon,
          cos_lat * sin_lon,
          sin_lat,
          0,  //
          at[0],
          at[1],
          at[2],
          1};
}

bool looks_like_ecef(const Bounds3d& bounds) {
  constexpr double kMostSide = 1e6, kMostHeight = 2e4, kHeightsOfMaps = 1e4;
  if (bounds.empty() || !(bounds.diagonal() < kMostSide)) return false;
  Vec3d centre{};
  for (std::size_t i = 0; i < 3; ++i) centre[i] = bounds.min[i] + (bounds.max[i] - bounds.min[i]) / 2;
  return std::abs(centre[2]) > kHeightsOfMaps && std::abs(globe_place(centre).height) < kMostHeight;
}

}  // namespace bp
