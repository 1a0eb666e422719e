#include <algorithm>
#include <random>

#include "lib/check/check_proxy.h"
#include "lib/check/detail/gap.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr int kSteps = 60;

/// Upper bound of the distance: from points of `a` to `b`.
double sampled_distance(const TriangleD& a, const TriangleD& b) {
  double least = HUGE_VAL;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      Vec3d p;
      const double s = double(i) / kSteps, t = double(j) / kSteps;
      for (std::size_t k = 0; k < 3; ++k) p[k] = a[0][k] + s * (a[1][k] - a[0][k]) + t * (a[2][k] - a[0][k]);
      least = std::min(least, std::sqrt(distance_squared(p, b)));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("the gap between two triangles is decided on either side of their distance", "[quick][check]") {
  const double far = GENERATE(0.0, 1e6);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  int apart = 0;
  for (int round = 0; round < 400; ++round) {
    TriangleD a, b;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        a[i][k] = far + place(random);
        b[i][k] = far + 0.6 + place(random) * (round % 3 == 0 ? 0.01 : 1);  // needles' ends, too
      }
    }
    if (round % 5 == 0) b = {{{a[0][0], a[0][1], a[0][2] + 1}, {a[1][0], a[1][1], a[1][2] + 1}, b[2]}};  // parallel
    const double most = sampled_distance(a, b), least = most - 4.0 / kSteps;
    CAPTURE(round, most);
    CHECK(keeps_gap(a, b, most + 1e-7) == Answer::refuted);
    if (least <= 0) continue;
    ++apart;
    CHECK(keeps_gap(a, b, least) == Answer::proven);
    CHECK(keeps_gap(b, a, least) == Answer::proven);
  }
  CHECK(apart > 100);
}

TEST_CASE("a proxy keeps a margin up to its least distance from the scene", "[quick][check]") {
  CheckOptions options;
  const IndexedMesh proxy = box({0, 0, 0}, {4, 4, 4});
  const std::vector<TriangleD> scene = triangles_of(box({1, 1, 0.5}, {2, 2, 2}));
  options.margin_world = 0.4999;
  CHECK(check(proxy, scene, options).holds());
  CHECK(check(proxy, scene, options).keeps_margin() == Answer::proven);
  options.margin_world = 0.5001;
  const CheckReport near = check(proxy, scene, options);
  CHECK(near.encloses());
  CHECK(near.answer() == Answer::refuted);
  CHECK(near.too_near.count == 10);  // all but those of the far side
  options.margin_world = 0;
  CHECK(check(proxy, scene, options).too_near.count == 0);
}
