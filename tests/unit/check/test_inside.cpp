#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

CheckReport inside_of(const IndexedMesh& proxy, const IndexedMesh& scene) {
  VectorSource source(triangles_of(scene));
  CheckOptions options;
  options.inside = true;
  return check_proxy(proxy, &source, options);
}

}  // namespace

TEST_CASE("a cube inside a cube is strictly inside, whichever way the outer one faces", "[quick][check]") {
  CHECK(inside_of(cube(1), cube(2)).holds());
  CHECK(inside_of(cube(1), inverted(cube(2))).holds());
  CHECK(inside_of(cube(1), join(cube(2), cube(1.5, {3, 0, 0}))).holds());  // overlapping closed parts
}

TEST_CASE("a proxy that touches the scene is not inside", "[quick][check]") {
  const CheckReport r = inside_of(cube(1), cube(1));
  CHECK_FALSE(r.holds());
  CHECK(r.touching.count > 0);
}

TEST_CASE("a proxy beside the scene, or around it, is not inside", "[quick][check]") {
  const CheckReport beside = inside_of(join(cube(0.5), cube(0.5, {5, 0, 0})), cube(2));
  CHECK_FALSE(beside.holds());
  CHECK(beside.outside_parts.count == 1);
  CHECK(beside.outside_parts.examples[0].index == 12);
  const CheckReport around = inside_of(cube(3), cube(2));
  CHECK_FALSE(around.holds());
  CHECK(around.swallowed.count == 12);
}

TEST_CASE("a proxy that swallows a part of the scene is not inside", "[quick][check]") {
  const CheckReport r = inside_of(cube(1), join(cube(2), cube(0.25, {0.1, 0.2, 0.3})));
  CHECK_FALSE(r.holds());
  CHECK(r.swallowed.count == 12);
  CHECK(r.outside_parts.count == 0);
}

TEST_CASE("a proxy in a cavity of the scene is inside: the walls are around it", "[quick][check]") {
  CHECK(inside_of(cube(1), join(cube(3), inverted(cube(2)))).holds());
  CHECK(inside_of(cube(1), join(join(cube(4), inverted(cube(3))), cube(2))).holds());
  const CheckReport beside = inside_of(join(cube(1), cube(0.5, {5, 0, 0})), join(cube(3), inverted(cube(2))));
  CHECK(beside.answer() == Answer::refuted);
  CHECK(beside.outside_parts.count == 1);
}

TEST_CASE("a proxy between closed parts that overlap is neither seen nor known to be enclosed", "[quick][check]") {
  IndexedMesh room;  // six slabs
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-4.0, 4.0}) {
      IndexedMesh slab = cube(1);
      for (Vec3d& p : slab.vertices) {
        for (int i = 0; i < 3; ++i)
          p[std::size_t(i)] = i == axis ? p[std::size_t(i)] / 2 + side : 6 * p[std::size_t(i)];
      }
      room = join(room, slab);
    }
  }
  const CheckReport r = inside_of(cube(1), room);
  CHECK(r.scene_closed);
  CHECK(r.answer() == Answer::undecided);
  CHECK(r.unsettled_parts.count == 1);
  CHECK(r.outside_parts.count == 0);
}

TEST_CASE("of an open scene it is refuted what is seen along an axis, and nothing is proven", "[quick][check]") {
  IndexedMesh open = cube(2);
  open.triangles.pop_back();
  const CheckReport hidden = inside_of(cube(0.5, {-1, -1, -1}), open);
  CHECK_FALSE(hidden.scene_closed);
  CHECK(hidden.touching.count + hidden.swallowed.count == 0);
  open.triangles.pop_back();
  CHECK(inside_of(cube(1), open).answer() == Answer::refuted);
  IndexedMesh turned = cube(2);
  std::swap(turned.triangles[0][1], turned.triangles[0][2]);
  CHECK(inside_of(cube(1), turned).answer() == Answer::undecided);
}

TEST_CASE("a triangle of no area closes T-junctions, and is kept out of the proxy as the segment that it is",
          "[quick][check]") {
  IndexedMesh scene = cube(2);
  const auto middle = std::uint32_t(scene.vertices.size());
  scene.vertices.push_back({0, -2, -2});  // of the edge from vertex 0 to vertex 1
  scene.triangles[4] = {0, middle, 5};    // was {0, 1, 5}
  scene.triangles.insert(scene.triangles.begin(), {middle, 1, 5});
  CHECK_FALSE(inside_of(cube(1), scene).scene_closed);
  scene.triangles.insert(scene.triangles.begin(), {0, 1, middle});
  const CheckReport r = inside_of(cube(1), scene);
  CHECK(r.holds());
  CHECK(r.scene_triangles == 14);
  IndexedMesh thread;
  thread.vertices = {{-0.5, 0, 0}, {0, 0, 0}, {0.5, 0, 0}};
  thread.triangles = {{0, 2, 1}};
  const CheckReport within = inside_of(cube(1), join(thread, cube(2)));
  REQUIRE(within.swallowed.count == 1);
  CHECK(within.swallowed.examples[0].index == 0);
  CHECK(inside_of(cube(3), join(thread, cube(2))).swallowed.count == 13);
  thread.vertices[0] = {-1, 0, 0};  // on the proxy's surface
  CHECK(inside_of(cube(1), join(thread, cube(2))).touching.count == 1);
  thread.vertices = {{-1.5, 0, 0}, {-1.25, 0, 0}, {-1.125, 0, 0}};
  CHECK(inside_of(cube(1), join(thread, cube(2))).holds());
}

TEST_CASE("where triangles of the scene cannot be judged, being seen from outside is not decided", "[quick][check]") {
  IndexedMesh scene = cube(2);
  for (Vec3d& p : scene.vertices) {
    if (p[0] < 0) p[0] = 1e-200;
  }
  const CheckReport r = inside_of(cube(0.5, {1, 0, 0}), scene);
  CHECK(r.undecidable_scene.count > 0);
  CHECK(r.insideness() == Answer::undecided);
}
