#include <cmath>

#include "lib/core/vec3.h"
#include "lib/geometry/smooth_normals.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("normals are smooth across small bends, and not across large ones", "[quick][geometry]") {
  const double degrees = GENERATE(0.0, 20.0, 39.0, 41.0, 90.0);
  CAPTURE(degrees);
  const double a = degrees * M_PI / 180;
  // Two triangles of one size at an edge along y; the second one is bent down.
  const std::vector<TriangleD> bent{{{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}},
                                    {{{0, 0, 0}, {std::cos(a), 0, -std::sin(a)}, {0, 1, 0}}}};
  const auto normals = smooth_normals(bent);
  const Vec3d at_edge = unpack_normal(normals[0][0]);
  const double wanted = degrees < 40 ? a / 2 : 0;
  CHECK(std::abs(std::atan2(at_edge[0], at_edge[2]) - wanted) < 1e-3);
  CHECK(length(unpack_normal(normals[0][2]) - Vec3d{0, 0, 1}) < 1e-3);  // away from the edge
}
