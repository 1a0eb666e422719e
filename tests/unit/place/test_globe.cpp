#include <cmath>

#include "lib/core/vec3.h"
#include "lib/place/globe.h"
#include "lib/place/placement.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// A place, and its ECEF coordinates by `cct -d 9 +proj=cart +ellps=WGS84` of PROJ 9.1.1.
struct KnownPlace {
  GlobePlace place;
  Vec3d ecef;
};
const KnownPlace kKnown[] = {
    {{4.36, 52.01, 43}, {3922725.032782061, 299082.595903866, 5003522.188860035}},
    {{-70.6693, -33.4489, 520.25}, {1763552.257333579, -5027277.800067651, -3495893.478308978}},
    {{0, 90, -12}, {0, 0, 6356740.314245179}},
    {{180, 0, 100000}, {-6478137, 0, 0}},
    {{103.8198, 1.3521, -5}, {-1523116.922331004, 6191783.559545089, 149493.762721649}},
    {{-122.5, -89.999, 2835}, {-60.039717099, -94.243477984, -6359587.313270034}}};

Bounds3d around(const Vec3d& p, double reach) {
  Bounds3d b;
  b.add({p[0] - reach, p[1] - reach, p[2] - reach});
  b.add({p[0] + reach, p[1] + reach, p[2] + reach});
  return b;
}

}  // namespace

TEST_CASE("places on the globe are those of PROJ", "[quick][place]") {
  const KnownPlace known = GENERATE(from_range(std::begin(kKnown), std::end(kKnown)));
  CAPTURE(known.place.lon, known.place.lat);
  CHECK(length(ecef_of(known.place) - known.ecef) < 1e-8);
  const GlobePlace back = globe_place(known.ecef);
  CHECK(std::abs(back.lat - known.place.lat) < 1e-11);
  CHECK(std::abs(back.height - known.place.height) < 1e-6);
  if (std::abs(known.place.lat) < 89) CHECK(std::abs(back.lon - known.place.lon) < 1e-11);
}

TEST_CASE("a place's axes point east, north and up", "[quick][place]") {
  const KnownPlace known = GENERATE(from_range(std::begin(kKnown), std::end(kKnown)));
  const GlobeMatrix m = east_north_up(known.place);
  const Vec3d east{m[0], m[1], m[2]}, north{m[4], m[5], m[6]}, up{m[8], m[9], m[10]};
  CHECK(std::abs(length(east) - 1) + std::abs(length(north) - 1) < 1e-15);
  CHECK(length(cross(east, north) - up) < 1e-15);
  GlobePlace higher = known.place;
  higher.height += 1000;
  CHECK(length(ecef_of(higher) - known.ecef - 1000 * up) < 1e-8);
  CHECK(std::abs(east[2]) < 1e-15);  // along a parallel
  CHECK(north[2] >= 0);
  CHECK((Vec3d{m[12], m[13], m[14]} == ecef_of(known.place)));
}

TEST_CASE("the point that a placement names stands at its place", "[quick][place]") {
  Placement placement;
  placement.place = {4.36, 52.01, 43};
  placement.at = {84900, 447600, 3};
  const GlobeMatrix m = to_ecef(placement);
  Vec3d p{};
  for (std::size_t i = 0; i < 3; ++i) p[i] = m[i] * 84900 + m[4 + i] * 447600 + m[8 + i] * 3 + m[12 + i];
  CHECK(length(p - ecef_of(placement.place)) < 1e-8);
}

TEST_CASE("ECEF coordinates are told from those of maps", "[quick][place]") {
  CHECK(looks_like_ecef(around(kKnown[0].ecef, 300)));
  CHECK(looks_like_ecef(around(kKnown[4].ecef, 300)));
  CHECK_FALSE(looks_like_ecef(around({0, 0, 0}, 300)));
  CHECK_FALSE(looks_like_ecef(around({85000, 447000, 5}, 300)));     // RD New
  CHECK_FALSE(looks_like_ecef(around({561000, 6352000, 20}, 300)));  // UTM 32N at 57.3 N: as far from 0 as ECEF
  CHECK_FALSE(looks_like_ecef(around({0.6 * 6378137, 0.8 * 6378137, 3e6}, 300)));  // far above the ground
  CHECK_FALSE(looks_like_ecef(around(kKnown[0].ecef, 5e6)));
}
