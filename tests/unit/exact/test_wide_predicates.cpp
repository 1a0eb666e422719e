#include <limits>
#include <random>

#include "lib/exact/predicates.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/exact/wide_predicates.h"
#include "lib/geometry/crossing.h"
#include "tests/catch.h"

using namespace bp;

namespace {

constexpr double kLeast = std::numeric_limits<double>::denorm_min(), kMost = std::numeric_limits<double>::max();

WidePoint scaled(const Vec3d& p, int exponent) {
  return {{std::ldexp(p[0], exponent), std::ldexp(p[1], exponent), std::ldexp(p[2], exponent)}};
}

}  // namespace

TEST_CASE("wide predicates agree with those in doubles, at every scale", "[quick][core]") {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> small(-3, 3);  // many degenerate places
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    std::array<Vec3d, 4> p;
    for (Vec3d& q : p) {
      for (double& c : q) c = n % 2 == 0 ? small(random) : any(random);
    }
    const int three = orient3d(p[0], p[1], p[2], p[3]);
    for (const int exponent : {0, -1000, 900}) {
      std::array<WidePoint, 4> w;
      for (std::size_t i = 0; i < 4; ++i) w[i] = scaled(p[i], exponent);
      REQUIRE(orient3d(w[0], w[1], w[2], w[3]) == three);
      for (int axis = 0; axis < 3; ++axis)
        REQUIRE(orient2d(w[0], w[1], w[2], axis) == orient2d(p[0], p[1], p[2], axis));
    }
    REQUIRE(crossing_above(WideTriangle{WidePoint{p[0]}, WidePoint{p[1]}, WidePoint{p[2]}}, WidePoint{p[3]}) ==
            crossing_above(TriangleD{p[0], p[1], p[2]}, p[3]));
  }
}

TEST_CASE("wide predicates see the least double beside the largest", "[quick][core]") {
  const WidePoint a{{0, 0, 0}}, b{{kMost, 0, 0}}, c{{0, kMost, 0}};
  CHECK(orient3d(a, b, c, WidePoint{{1, 1, kLeast}}) == 1);
  CHECK(orient3d(a, b, c, WidePoint{{1, 1, -kLeast}}) == -1);
  CHECK(orient3d(a, b, c, WidePoint{{-kMost, kLeast, 0}}) == 0);
  CHECK(orient2d(a, b, WidePoint{{kMost, kLeast, 0}}, 2) == 1);
  CHECK(orient2d(a, WidePoint{{kLeast, kLeast, 0}}, WidePoint{{kMost, kMost, 0}}, 2) == 0);
  CHECK(orient2d(WidePoint{{-kMost, 0, 0}}, WidePoint{{kMost, -kLeast, 0}}, WidePoint{{kMost, 0, 0}}, 2) == 1);
  const WideTriangle floor = widened({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}});
  const WideTriangle above = widened({{{-1, -1, kLeast}, {1, -1, kLeast}, {0, 1, kLeast}}});
  CHECK_FALSE(triangles_intersect(floor.data(), above.data()));
  CHECK(triangles_intersect(floor.data(), widened({{{0, 0, -kLeast}, {1, 0, kLeast}, {0, 1, kLeast}}}).data()));
}
