#include <random>

#include "lib/core/vec3.h"
#include "lib/geometry/apart.h"
#include "lib/geometry/triangle_bvh.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// The least distance of points of one triangle from the other one: never below that of the triangles.
double sampled_distance(const TriangleD& a, const TriangleD& b) {
  constexpr int kSteps = 12;
  double least = HUGE_VAL;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const Vec3d p = a[0] + double(i) / kSteps * (a[1] - a[0]) + double(j) / kSteps * (a[2] - a[0]);
      least = std::min(least, std::sqrt(distance_squared(p, b)));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("triangles that are apart by a distance have no points nearer than that", "[quick][geometry]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  int apart = 0;
  for (int round = 0; round < 2000; ++round) {
    TriangleD a, b;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) a[i][k] = place(random), b[i][k] = place(random) + 0.8;
    }
    if (round % 5 == 1) b[2] = b[1];                                                      // a segment
    if (round % 5 == 2) b[2] = b[1] = b[0];                                               // a point
    if (round % 5 == 3) a[0][2] = a[1][2] = a[2][2] = b[0][2] = b[1][2] = b[2][2] = 0.5;  // in one plane
    const double distance = std::min(sampled_distance(a, b), sampled_distance(b, a));
    CAPTURE(round, distance);
    CHECK_FALSE(are_apart(a, b, distance));
    apart += are_apart(a, b, distance / 2);
    if (are_apart(a, b, 0.1)) CHECK(are_apart(b, a, 0.1));
  }
  CHECK(apart > 1200);
}

TEST_CASE("a gap is told from the next double, far from the origin, too", "[quick][geometry]") {
  const TriangleD low{{{1e6, 1e6, 0}, {1e6 + 1, 1e6, 0}, {1e6, 1e6 + 1, 0}}};
  TriangleD high = low;
  for (Vec3d& p : high) p[2] = 1e-6;
  CHECK(are_apart(low, high, 0.99e-6));
  CHECK_FALSE(are_apart(low, high, 1.01e-6));
}
