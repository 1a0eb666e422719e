#include <random>

#include "lib/core/vec3.h"
#include "lib/mesh/constrained_minimum.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("a minimum to which constraints are added is the one of all of them at once", "[quick][meshing]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&] { return Vec3d{any(random), any(random), any(random)}; };
  int found = 0, none = 0;
  for (int n = 0; n < 2000; ++n) {
    Quadric q;
    for (int k = 0; k < 4; ++k) q.add_plane(unit(point(), {1, 0, 0}), any(random), 1);
    const Vec3d prior = point();
    GrowingMinimum growing(q, prior);
    std::vector<PlaneConstraint> constraints;
    for (int round = 0; round < 5; ++round) {
      for (int k = 0; k < 2; ++k) constraints.push_back({unit(point(), {1, 0, 0}), any(random)});
      const auto at_once = constrained_minimum(q, prior, constraints);
      REQUIRE(growing.under(constraints) == at_once);
      ++(at_once ? found : none);
      if (!at_once) break;
      for (const PlaneConstraint& c : constraints) CHECK(dot(c.n, *at_once) > c.d - 1e-3);
    }
  }
  CHECK(found > 1000);
  CHECK(none > 100);
}
