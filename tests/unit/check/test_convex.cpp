#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

CheckReport convex_of(const IndexedMesh& proxy, const IndexedMesh& scene) {
  VectorSource source(triangles_of(scene));
  CheckOptions options;
  options.convex = true;
  return check_proxy(proxy, &source, options);
}

}  // namespace

TEST_CASE("convex parts may overlap, and hold what lies strictly within one of them", "[quick][check]") {
  const IndexedMesh two = join(cube(2), cube(2, {1, 0.5, 0.25}));
  const CheckReport both = convex_of(two, join(cube(1), cube(1, {1.5, 1, 1})));
  CHECK(both.holds());
  CHECK(both.scene_triangles == 24);
  CHECK_FALSE(check(two, triangles_of(cube(1))).holds());  // as one mesh, they intersect
  CHECK(convex_of(sphere(3, 2), cube(1)).holds());         // each of many faces
}

TEST_CASE("what touches a part from within, or lies in no single one, is not held", "[quick][check]") {
  CHECK(convex_of(cube(2), cube(2)).not_held.count == 12);
  CHECK(convex_of(cube(2), cube(3)).not_held.count == 12);
  const IndexedMesh two = join(cube(1), cube(1, {1, 0, 0}));
  const CheckReport across = convex_of(two, box({-0.5, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  CHECK_FALSE(across.holds());
  CHECK(across.not_held.count == 8);  // not the ends, which lie in one each
  const CheckReport partly = convex_of(cube(2), join(cube(1), cube(1, {5, 0, 0})));
  REQUIRE(partly.not_held.count == 12);
  CHECK(partly.not_held.examples[0].index == 12);
}

TEST_CASE("a part with a dent, or one that faces inwards, is not convex", "[quick][check]") {
  CHECK(convex_of(cube(2), cube(1)).nonconvex_parts.count == 0);
  IndexedMesh dented = sphere(2, 2);
  dented.vertices[20] = {0, 0, 0};
  const CheckReport r = convex_of(join(cube(2), dented), cube(1));
  CHECK_FALSE(r.holds());
  REQUIRE(r.nonconvex_parts.count == 1);
  CHECK(r.nonconvex_parts.examples[0].index == 12);
  CHECK(convex_of(inverted(cube(2)), cube(1)).nonconvex_parts.count == 1);
  IndexedMesh open = cube(2);
  open.triangles.pop_back();
  CHECK_FALSE(convex_of(open, cube(1)).convex());
}

TEST_CASE("a part that intersects itself is found, parts that intersect each other are not", "[quick][check]") {
  IndexedMesh knot = join(cube(1), cube(1, {1, 0.5, 0.25}));
  CHECK(convex_of(knot, cube(0.5)).self_intersections.count == 0);
  knot.vertices[0] = {0, 0, 3};  // through the top
  CHECK(convex_of(knot, cube(0.5)).self_intersections.count > 0);
}
