#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/image/clip.h"
#include "tests/catch.h"

using namespace bp;

namespace {

double area(const TriangleD& t) {
  return ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1])) / 2;
}

double area(const std::vector<ClippedTriangle>& parts) {
  double sum = 0;
  for (const ClippedTriangle& part : parts) sum += area(part.corners);
  return sum;
}

const LinearColor kBlack{0, 0, 0};

}  // namespace

TEST_CASE("a triangle is cut off at the square's sides, and keeps plane and colours", "[quick][image]") {
  // z and red rise along x, green along y.
  const TriangleD t{{{0, 0, 0}, {100, 0, 100}, {0, 100, 0}}};
  const TriangleColors colors{kBlack, LinearColor{50000, 0, 0}, LinearColor{0, 50000, 0}};
  const auto parts = clip(t, colors, 10);
  CHECK(area(parts) == Approx(100));
  for (const ClippedTriangle& part : parts) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& p = part.corners[k];
      CHECK((std::abs(p[0]) <= 10 && std::abs(p[1]) <= 10));
      CHECK(p[2] == Approx(p[0]));
      CHECK(part.colors[k].r == Approx(500 * p[0]).margin(1));
      CHECK(part.colors[k].g == Approx(500 * p[1]).margin(1));
    }
  }
  REQUIRE(clip(t, colors, 200).size() == 1);
  CHECK(clip(t, colors, 200)[0].corners == t);
  const TriangleD around{{{-1e9, -1e9, 0}, {1e9, -1e9, 0}, {0, 1e9, 0}}};
  CHECK(area(clip(around, {}, 10)) == Approx(400));
  CHECK(clip(TriangleD{{{20, 0, 0}, {30, 0, 0}, {20, 9, 0}}}, {}, 10).empty());
  CHECK(clip(TriangleD{{{0, 0, 0}, {HUGE_VAL, 0, 0}, {0, 9, 0}}}, {}, 10).empty());
  CHECK(clip(TriangleD{{{0, 0, std::nan("")}, {1, 0, 0}, {0, 9, 0}}}, {}, 10).empty());
}

TEST_CASE("two triangles are cut at the same points of their edge", "[quick][image]") {
  const Vec3d a{-1234.5678, 3.3, 1}, b{987.654, -2.1, 7}, c{0, 500, 0}, d{7, -600, 0};
  const auto cut_points = [&](const TriangleD& t) {
    std::vector<Vec3d> points;
    for (const ClippedTriangle& part : clip(t, {}, 100)) {
      for (const Vec3d& p : part.corners)
        if (std::abs(p[0]) == 100 && std::abs(p[1]) < 50) points.push_back(p);
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  };
  REQUIRE(cut_points({a, b, c}).size() == 2);
  CHECK(cut_points({a, b, c}) == cut_points({b, a, d}));
}

TEST_CASE("a line is cut off like a triangle", "[quick][image]") {
  std::array<Vec3d, 2> line{Vec3d{-100, 0, -100}, Vec3d{300, 0, 300}};
  REQUIRE(clip(line, 10));
  CHECK(length(line[0] - Vec3d{-10, 0, -10}) < 1e-9);
  CHECK(length(line[1] - Vec3d{10, 0, 10}) < 1e-9);
  std::array<Vec3d, 2> beyond{Vec3d{-100, 50, 0}, Vec3d{300, 50, 0}}, passing{Vec3d{0, 25, 0}, Vec3d{25, 0, 0}},
      endless{Vec3d{0, 0, 0}, Vec3d{HUGE_VAL, 0, 0}};
  CHECK_FALSE(clip(beyond, 10));
  CHECK_FALSE(clip(passing, 10));
  CHECK_FALSE(clip(endless, 10));
}
