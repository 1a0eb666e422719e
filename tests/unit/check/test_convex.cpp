#include <random>

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

CheckReport covers(const IndexedMesh& proxy, const TriangleD& t) {
  IndexedMesh scene;
  scene.vertices.assign(t.begin(), t.end());
  scene.triangles = {{0, 1, 2}};
  return convex_of(proxy, scene);
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

TEST_CASE("what touches a part from within, or is not covered by parts, is not held", "[quick][check]") {
  CHECK(convex_of(cube(2), cube(2)).not_held.count == 12);
  CHECK(convex_of(cube(2), cube(3)).not_held.count == 12);
  const IndexedMesh two = join(cube(1), cube(0.99, {1.99, 0, 0}));  // they touch
  const CheckReport across = convex_of(two, box({-0.5, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  CHECK_FALSE(across.holds());
  CHECK(across.perhaps_not_held.count == 8);  // not the ends, which lie in one each
  CHECK(across.answer() == Answer::undecided);
  const CheckReport partly = convex_of(cube(2), join(cube(1), cube(1, {5, 0, 0})));
  REQUIRE(partly.not_held.count == 12);
  CHECK(partly.not_held.examples[0].index == 12);
}

TEST_CASE("parts that overlap hold together what lies in none of them alone", "[quick][check]") {
  const double overlap = GENERATE(0.25, 1e-3, 5e-10);  // 1e-10 of the coordinates: what the manual promises
  CAPTURE(overlap);
  IndexedMesh row;
  for (int i = 0; i < 5; ++i) row = join(row, box({double(i), -1, -1}, {i + 1 + overlap, 1, 1}));
  const IndexedMesh bar = box({0.1, -0.9, -0.9}, {4.9, 0.9, 0.9});
  const CheckReport held = convex_of(row, bar);
  CHECK(held.holds());
  CHECK(held.scene_triangles == 12);
  CHECK(convex_of(row, box({0.1, -0.9, -0.9}, {5.5, 0.9, 0.9})).not_held.count == 10);  // all but one end
  CHECK(covers(row, {{{0.3, -0.95, -0.2}, {4.7, 0.3, 0.9}, {2, 0.4, -0.99}}}).holds());
}

TEST_CASE("parts far from the origin are decided as those around it", "[quick][check]") {
  const double far = GENERATE(1e5, 1e9), overlap = GENERATE(1e-3, -1e-3);  // below 0: a gap
  CAPTURE(far, overlap);
  const double unit = 0x1p-20 * far;  // coordinates are exact
  const auto at = [&](double x, double y, double z) { return Vec3d{far + x * unit, -far + y * unit, far + z * unit}; };
  const IndexedMesh two = join(box(at(0, 0, 0), at(1 + overlap, 1, 1)), box(at(1, 0, 0), at(2, 1, 1)));
  const CheckReport r = convex_of(two, box(at(0.25, 0.25, 0.25), at(1.75, 0.75, 0.75)));
  CHECK(r.answer() == (overlap > 0 ? Answer::proven : Answer::refuted));
  CHECK(r.perhaps_not_held.count == 0);
}

TEST_CASE("near-overlaps of random boxes are never called what they are not", "[quick][check]") {
  std::mt19937 random(44);
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_int_distribution<int> power(-52, -2);
  int proven = 0, refuted = 0;
  for (int i = 0; i < 300; ++i) {
    const double far = i % 3 == 0 ? 0 : std::ldexp(1.0, i % 30),
                 by = std::ldexp(i % 2 == 0 ? 1.0 : -1.0, power(random));
    const Vec3d c{far + place(random), far + place(random), -far};
    const double side = c[0] + 1 + by;  // as rounded
    if (side == c[0] + 1) continue;
    const IndexedMesh two = join(box({c[0], c[1], c[2]}, {side, c[1] + 1, c[2] + 1}),
                                 box({c[0] + 1, c[1], c[2]}, {c[0] + 2, c[1] + 1, c[2] + 1}));
    const CheckReport r =
        convex_of(two, box({c[0] + 0.25, c[1] + 0.25, c[2] + 0.25}, {c[0] + 1.75, c[1] + 0.75, c[2] + 0.75}));
    CAPTURE(i, by, far);
    if (side > c[0] + 1)
      CHECK(r.answer() != Answer::refuted);
    else
      CHECK(r.answer() != Answer::proven);
    proven += r.answer() == Answer::proven, refuted += r.answer() == Answer::refuted;
  }
  CHECK(proven > 60);
  CHECK(refuted > 60);
}

TEST_CASE("a gap between parts is found, and is never proven where they only touch", "[quick][check]") {
  const double gap = GENERATE(0.5, 1e-6, 1e-12, 0.0);
  const Answer answer = gap > 0 ? Answer::refuted : Answer::undecided;
  CAPTURE(gap);
  const IndexedMesh two = join(box({0, 0, 0}, {1, 1, 1}), box({1 + gap, 0.01, 0.02}, {2, 0.9, 0.8}));
  const CheckReport r = convex_of(two, box({0.5, 0.4, 0.4}, {1.75, 0.6, 0.6}));
  CHECK(r.answer() == answer);
  CHECK(r.not_held.count + r.perhaps_not_held.count == 8);
  const double g = gap / 2;  // a hole amid four parts: no corner of a triangle over it lies there
  const IndexedMesh ring = join(join(box({-2, -2, -1}, {-g, 2, 1}), box({g, -2, -1.1}, {2, 2.1, 1.1})),
                                join(box({-2.1, -2.1, -1.2}, {2.1, -g, 1.2}), box({-2.2, g, -1.3}, {2.2, 2.2, 1.3})));
  CHECK(covers(ring, {{{-1.5, -1.5, 0}, {1.6, -1.5, 0}, {0, 1.7, 0}}}).answer() != Answer::proven);
  CHECK(covers(ring, {{{-1.5, -1.5, 0}, {1.6, -1.5, 0}, {0, -0.6, 0}}}).answer() == Answer::proven);
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

TEST_CASE("parts may touch at a corner, where one surface may not", "[quick][check]") {
  const IndexedMesh touching = join(cube(1), cube(1, {2, 2, 2}));
  const CheckReport parts = convex_of(touching, cube(0.5));
  CHECK(parts.answer() == Answer::proven);
  CHECK(parts.nonmanifold_vertices.count == 0);
  CHECK(parts.genus == 0);
  CHECK(check_proxy(touching, nullptr).nonmanifold_vertices.count == 1);
  IndexedMesh pinched = cube(1);  // two corners of one part at one place
  pinched.vertices[7] = pinched.vertices[0];
  CHECK_FALSE(convex_of(pinched, cube(0.5)).holds());
}
