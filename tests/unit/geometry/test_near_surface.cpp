#include "lib/geometry/near_surface.h"
#include "tests/catch.h"
#include "tests/support/triangle_samples.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a triangle is held to be near only if all of its points are", "[quick][check]") {
  const TriangleBvh tree(random_triangles(5, 40, 0.3));
  const double place = GENERATE(0.01, 0.2, 5.0);
  const std::size_t places = GENERATE(1u, 64u, 4096u);
  NearSurface near(tree, place, places);
  int yes = 0, no = 0;
  for (const TriangleD& t : random_triangles(6, 200, 0.4)) {
    const double largest = sampled(t, tree, 24);
    for (const double factor : {0.5, 0.9, 1.1, 1.5}) {
      const bool holds = near.holds(t, largest * factor);
      if (factor < 1) CHECK_FALSE(holds);
      if (factor > 1.2) CHECK(holds);
      (holds ? yes : no) += 1;
    }
  }
  CHECK(yes > 200);
  CHECK(no >= 400);
}

TEST_CASE("distances of points are exact above what is enough", "[quick][check]") {
  const TriangleBvh tree(random_triangles(8, 40, 0.3));
  NearSurface near(tree, 0.1, 256);
  for (const TriangleD& t : random_triangles(9, 100, 0.8)) {
    for (const Vec3d& p : t) {
      const double exact = std::sqrt(tree.nearest(p).distance_squared);
      CHECK(near.distance(p) == exact);
      CHECK(near.distance(p, exact * 0.9) == exact);
      CHECK(near.distance(p, exact * 1.2) >= exact);
      CHECK(near.distance(p, exact * 1.2) <= exact * 1.2);
    }
  }
}

// Halves would have to be as small as the limit along all edges below: millions of them.
TEST_CASE("a triangle over a mosaic is near within any limit", "[quick][check]") {
  std::vector<TriangleD> mosaic;
  const int n = 12;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = i / 3.0, y = j / 7.0, x1 = (i + 1) / 3.0, y1 = (j + 1) / 7.0;
      mosaic.push_back({Vec3d{x, y, 0}, Vec3d{x1, y, 0}, Vec3d{x1, y1, 0}});
      mosaic.push_back({Vec3d{x, y, 0}, Vec3d{x1, y1, 0}, Vec3d{x, y1, 0}});
    }
  }
  const TriangleBvh tree(mosaic);
  NearSurface near(tree, 0.1, 1024);
  const double limit = GENERATE(1e-9, 1e-5, 0.05, 3.0);
  const double height = GENERATE(0.0, 0.5) * limit;
  const Vec3d a{0.1, 0.2, height}, b{3.9, 0.05, -height}, c{1.3, 1.7, height};
  CHECK(near.holds({a, b, c}, limit));
  CHECK_FALSE(near.holds({a, b, {1.3, 12.0 / 7 + 1.1 * limit, 0}}, limit));  // out over the side
}
