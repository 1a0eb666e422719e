#pragma once
#include <array>

#include "lib/core/box.h"

/// Places on the globe: the ellipsoid WGS 84 (a = 6378137 m, 1/f = 298.257223563), and ECEF coordinates, in metres from
/// its centre, z towards the north pole.
namespace bp {

using GlobeMatrix = std::array<double, 16>;  ///< 4 x 4 by columns

/// Longitude and latitude in degrees, and the height above the ellipsoid in metres.
struct GlobePlace {
  double lon = 0, lat = 0, height = 0;
};

/// Returns the ECEF coordinates of a place, right to within 2 nm near the ellipsoid.
[[nodiscard]] Vec3d ecef_of(const GlobePlace& place);
/// Returns the place of ECEF coordinates. It is right to within 1 um up to 100 km from the ellipsoid.
[[nodiscard]] GlobePlace globe_place(const Vec3d& ecef);
/// Returns the matrix from metres to the east, to the north and up at a place to ECEF coordinates.
[[nodiscard]] GlobeMatrix east_north_up(const GlobePlace& place);
/// Returns true if bounds (z up) look like ECEF coordinates of something on the ground. Coordinates of maps may be as
/// far from 0, but their heights are small: z within 10 km of 0 is taken for a height, also on the equator.
[[nodiscard]] bool looks_like_ecef(const Bounds3d& bounds);

}  // namespace bp
