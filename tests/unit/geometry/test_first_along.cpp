#include <cmath>

#include "lib/geometry/triangle_bvh.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

namespace {

std::vector<TriangleD> random_triangles(RandomLattice& random, int n) {
  std::vector<TriangleD> all;
  const auto point = [&](std::int64_t reach) {
    const LatticeCoord c = random.point(-reach, reach);
    return Vec3d{double(c.x), double(c.y), double(c.z)};
  };
  for (int i = 0; i < n; ++i) {
    const Vec3d at = point(100);
    TriangleD t;
    for (Vec3d& p : t) {
      p = point(30);
      for (std::size_t k = 0; k < 3; ++k) p[k] += at[k];
    }
    all.push_back(i % 10 == 9 ? all.back() : t);  // some twice, at one place
  }
  return all;
}

}  // namespace

TEST_CASE("the first triangle along a ray is the one that a look at all of them finds", "[quick][geometry]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomLattice random(seed);
    const std::vector<TriangleD> triangles = random_triangles(random, int(random.between(1, 300)));
    const TriangleBvh tree(triangles);
    for (int i = 0; i < 200; ++i) {
      const LatticeCoord a = random.point(-150, 150), b = random.point(-2, 2);
      const Vec3d start{double(a.x), double(a.y), double(a.z)};
      const Vec3d direction{100.0 * double(b.x), 100.0 * double(b.y), 100.0 * double(b.z)};  // along axes, too; or none
      const auto taken = [&](std::uint32_t id) { return (id + std::uint32_t(i)) % 3 != 0; };
      double first = HUGE_VAL;
      std::uint32_t id = 0;
      for (std::uint32_t k = 0; k < triangles.size(); ++k) {
        const double along = along_segment(start, direction, triangles[k]);
        if (taken(k) && along < first) first = along, id = k;
      }
      const auto hit = tree.first_along(
          start, direction, 1, [&](std::uint32_t item, double) { return taken(tree.item(item).id); },
          [&](std::uint32_t one, std::uint32_t other) { return tree.item(one).id < tree.item(other).id; });
      REQUIRE(hit.has_value() == (first < HUGE_VAL));
      if (!hit) continue;
      CHECK(hit->along == first);
      CHECK(tree.item(hit->item).id == id);
    }
  }
}

TEST_CASE("a ray meets a triangle from both sides, and as far as it goes", "[quick][geometry]") {
  const TriangleD t{Vec3d{0, 0, 0}, Vec3d{4, 0, 0}, Vec3d{0, 4, 0}};
  CHECK(along_segment({1, 1, 2}, {0, 0, -4}, t) == 0.5);
  CHECK(along_segment({1, 1, -2}, {0, 0, 4}, t) == 0.5);
  CHECK(along_segment({2, 2, 1}, {0, 0, -1}, t) == 1);
  CHECK(std::isnan(along_segment({1, 1, 2}, {0, 0, -1.9}, t)));
  CHECK(std::isnan(along_segment({1, 1, 2}, {0, 0, 4}, t)));
  CHECK(std::isnan(along_segment({3, 3, 2}, {0, 0, -4}, t)));
  CHECK(std::isnan(along_segment({1, 1, 0}, {1, 0, 0}, t)));
  const auto any = [](std::uint32_t, double) { return true; };
  CHECK_FALSE(TriangleBvh({}).first_along({0, 0, 0}, {1, 1, 1}, 1, any, any));
  const auto each = [](std::uint32_t) { return true; };
  CHECK_FALSE(TriangleBvh({}).nearest_within({0, 0, 0}, 1, each, any));
}

TEST_CASE("the nearest triangle is one that is accepted", "[quick][geometry]") {
  const auto at_height = [](double z) { return TriangleD{Vec3d{0, 0, z}, Vec3d{4, 0, z}, Vec3d{0, 4, z}}; };
  const TriangleBvh tree({at_height(1), at_height(2), at_height(3)});
  const auto nearest = [&](double most, std::uint32_t least_id) {
    const auto accept = [&](std::uint32_t item) { return tree.item(item).id >= least_id; };
    const auto found = tree.nearest_within({1, 1, 0}, most, accept, std::less<std::uint32_t>());
    return found ? int(tree.item(found->item).id) : -1;
  };
  CHECK(nearest(100, 0) == 0);
  CHECK(nearest(100, 1) == 1);
  CHECK(nearest(9, 2) == 2);
  CHECK(nearest(8, 2) == -1);
}
