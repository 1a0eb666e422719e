#include <algorithm>
#include <random>

#include "lib/check/check_proxy.h"
#include "lib/check/detail/gap.h"
#include "lib/core/vec3.h"
#include "lib/exact/triangle_intersection.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Returns the distance between the segments from p to p + u and from q to q + v.
double segment_distance(const Vec3d& p, const Vec3d& u, const Vec3d& q, const Vec3d& v) {
  const Vec3d w = p - q;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w), det = uu * vv - uv * uv;
  double least = HUGE_VAL;
  const auto try_at = [&](double s) {  // and the nearest point of the other segment
    s = std::clamp(s, 0.0, 1.0);
    const double t = std::clamp((uv * s + vw) / vv, 0.0, 1.0);
    s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
    least = std::min(least, length(w + s * u - t * v));
  };
  for (const double s : {0.0, 1.0, det > 0 ? (uv * vw - vv * uw) / det : 0.5}) try_at(s);
  return least;
}

/// Returns the distance of triangles that do not meet: it is between edges, or from a corner.
double distance_between(const TriangleD& a, const TriangleD& b) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, std::sqrt(distance_squared(a[i], b)), std::sqrt(distance_squared(b[i], a))});
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, segment_distance(a[i], a[(i + 1) % 3] - a[i], b[k], b[(k + 1) % 3] - b[k]));
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
    const double rounding = far > 0 ? 1e-5 : 1e-9;
    const bool meet = triangles_intersect(a.data(), b.data());
    const double distance = meet ? 0 : distance_between(a, b);
    CAPTURE(round, distance);
    CHECK(keeps_gap(a, b, distance + rounding) == Answer::refuted);
    if (distance <= rounding) continue;
    ++apart;
    CHECK(keeps_gap(a, b, distance - rounding) == Answer::proven);
    CHECK(keeps_gap(b, a, distance - rounding) == Answer::proven);
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

TEST_CASE("the least distance is found, and a wide margin is refuted by the first face", "[quick][check]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto triangle = [&](double x) {
    TriangleD t;
    for (Vec3d& p : t) p = {x + place(random) / 4, place(random), place(random)};
    return t;
  };
  std::vector<TriangleD> faces;
  for (int i = 0; i < 200; ++i) faces.push_back(triangle(2 + i % 7));
  const TriangleBvh surface(faces);
  for (int round = 0; round < 50; ++round) {
    const TriangleD t = triangle(0);
    double least = HUGE_VAL;
    for (const TriangleD& face : faces) least = std::min(least, distance_between(t, face));
    CHECK(gap_within(t, surface, HUGE_VAL) == Approx(least));
    CHECK(gap_within(t, surface, least / 2) == least / 2);
    CHECK(keeps_gap(t, surface, least * 0.999).answer == Answer::proven);
    CHECK(keeps_gap(t, surface, least * 1.001).answer == Answer::refuted);
    CHECK(keeps_gap(t, surface, 1e6).answer == Answer::refuted);
  }
}
