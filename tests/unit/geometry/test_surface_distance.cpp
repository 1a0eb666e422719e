#include "lib/core/parallel.h"
#include "lib/geometry/surface_distance.h"
#include "tests/catch.h"
#include "tests/support/triangle_samples.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("the distance between two squares, one above the other and twice as large, is known", "[quick][check]") {
  const auto square = [](double half, double z) {
    const Vec3d a{-half, -half, z}, b{half, -half, z}, c{half, half, z}, d{-half, half, z};
    return std::vector<TriangleD>{{a, b, c}, {a, c, d}};
  };
  const std::vector<TriangleD> small = square(1, 0), large = square(2, 0.5);
  const SurfaceDistance up = surface_distance(small, TriangleBvh(large));
  CHECK(up.at_least == 0.5);
  CHECK(up.at_most == 0.5);
  CHECK(std::abs(up.mean - 0.5) < 1e-12);
  const SurfaceDistance down = surface_distance(large, TriangleBvh(small));  // farthest at the corners: (1, 1, 0.5)
  CHECK(down.at_least <= 1.5);
  CHECK(down.at_most >= 1.5);
  CHECK(down.at_most - down.at_least <= 1.001e-3 * 1.5);
  CHECK(down.mean > 0.5);
  CHECK(down.mean < 1.5);
  const SurfaceDistance largest = largest_distance(large, TriangleBvh(small));
  CHECK(largest.at_most == down.at_most);
  CHECK(largest.at_least == down.at_least);
  CHECK(largest.mean == 0);
}

TEST_CASE("far from the origin the search for a distance ends where coordinates are rounded", "[quick][check]") {
  const double far = 1.1e10;  // units in the last place of 2^-19
  std::vector<TriangleD> one, other;
  for (int i = 0; i < 20; ++i) {
    const double a = 0.31 * i, x = far + 0.05 * i;
    one.push_back({{{x, std::cos(a), far}, {x + 0.05, std::cos(a + 0.3), far}, {x, std::sin(a), far + 0.7}}});
    other.push_back({{{x, std::cos(a), far + 1e-6}, {x + 0.05, std::cos(a + 0.3), far}, {x, std::sin(a), far + 0.7}}});
  }
  const SurfaceDistance d = surface_distance(one, TriangleBvh(other));
  CHECK(d.at_most < 1e-3);
  // As narrow as the rounding: pieces for the mean cannot be made smaller either.
  const double step = far * 0x1p-52;
  const std::vector<TriangleD> narrow{{{{far, 0, 0}, {far + step, 0, 0}, {far, step, 0}}}};
  CHECK(surface_distance(narrow, TriangleBvh(narrow)).at_most <= 1e-3);
}

TEST_CASE(
    "surfaces that are equally far everywhere are measured part by part of the nearest, not by ever smaller parts",
    "[quick][check]") {
  std::vector<TriangleD> fine, shifted;  // tens of millions of halves, were they not cut at edges
  constexpr int kCells = 96;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const auto add = [](std::vector<TriangleD>& to, double x, double y, double z, double angle) {
        const double c = std::cos(angle), s = std::sin(angle);
        const auto at = [&](double u, double v) { return Vec3d{c * u - s * v, s * u + c * v, z}; };
        to.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
        to.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
      };
      add(fine, i - kCells / 2, j - kCells / 2, 0, 0);
      if (std::hypot(i - kCells / 2, j - kCells / 2) < 40) add(shifted, i - kCells / 2, j - kCells / 2, 0.01, 0.3);
    }
  }
  const SurfaceDistance d = surface_distance(shifted, TriangleBvh(fine));
  CHECK(d.at_least == 0.01);
  CHECK(d.at_most <= 0.01 + 120 * 1e-7);  // of the diagonal
}

TEST_CASE("the search for the largest distance gives up exactness for speed, and never the bound", "[quick][check]") {
  std::vector<TriangleD> hills;  // no part of a plane above is nearest to one triangle for long
  constexpr int kCells = 64;
  const auto at = [](int i, int j) {
    return Vec3d{double(i), double(j), 0.05 * std::sin(i * 1.7) * std::cos(j * 2.3)};
  };
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      hills.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      hills.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const std::vector<TriangleD> above{{Vec3d{0, 0, 9}, {kCells, 0, 9}, {0, kCells, 9}}};
  const TriangleBvh tree(hills);
  const SurfaceDistance exact = largest_distance(above, tree, 1e-4);
  const SearchEffort less = GENERATE(SearchEffort{64, 1 << 18}, SearchEffort{std::size_t(1) << 62, 64});
  const SurfaceDistance quick = largest_distance(above, tree, 1e-4, less);
  CHECK(quick.at_most >= exact.at_least);
  CHECK(quick.at_most > exact.at_most);
  CHECK(quick.at_most < 1.2 * exact.at_least);
  CHECK(quick.at_least <= exact.at_most);
}

TEST_CASE("needles and triangles without area are measured too", "[quick][check]") {
  std::vector<TriangleD> to;
  for (int i = 0; i < 40; ++i) {
    const double x = i;
    to.push_back({Vec3d{x, -30, 0}, Vec3d{x + 1, -30, 0}, Vec3d{x, 30, 0}});
    to.push_back({Vec3d{x + 1, -30, 0}, Vec3d{x + 1, 30, 0}, Vec3d{x, 30, 0}});
  }
  const Vec3d a{4.4157954328344191, 2.1708984375, 0.66796875},
      b{33.9886933257318615, 2.5048828125, 0.33398437499999989};
  const Vec3d beside{4.4157954328344191, 2.1708984375, 0.66796875000000033};
  const std::vector<TriangleD> from{{a, b, a}, {beside, b, a}, {b, b, b}};
  const SurfaceDistance d = surface_distance(from, TriangleBvh(to));
  CHECK(d.at_least == 0.66796875000000033);
  CHECK(d.at_most <= d.at_least * 1.0011);
}

TEST_CASE("the largest distance lies between its bounds, for any number of threads", "[quick][check]") {
  const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
  const std::vector<TriangleD> from = random_triangles(seed, 700, 0.2), to = random_triangles(seed + 100, 50, 0.3);
  const TriangleBvh tree(to);
  const SurfaceDistance d = surface_distance(from, tree);
  double largest = 0;
  for (const TriangleD& t : from) largest = std::max(largest, sampled(t, tree, 6));
  CHECK(largest <= d.at_most * (1 + 1e-12));
  CHECK(d.at_least <= d.at_most);
  CHECK(d.at_most <= d.at_least * 1.0011);
  CHECK(std::sqrt(tree.nearest(d.where).distance_squared) == d.at_least);
  CHECK(d.mean > 0);
  CHECK(d.mean < d.at_most);
  const ThreadLimit one(1);
  const SurfaceDistance again = surface_distance(from, tree);
  CHECK(again.mean == d.mean);
  CHECK(again.at_most == d.at_most);
}
