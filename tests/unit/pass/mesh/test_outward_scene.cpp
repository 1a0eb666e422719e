#include "lib/check/check_proxy.h"
#include "lib/core/vec3.h"
#include "lib/pass/mesh/outward_scene.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

namespace bp::test {

namespace {

GridFrame frame_of(const Triangles& scene, double voxel) {
  Bounds3d bounds;
  for (const TriangleD& t : scene) {
    for (const Vec3d& p : t) bounds.add(p);
  }
  return make_frame(bounds, voxel);
}

/// The proxy of a scene that has one, proven by the checker.
LatticeMesh proven(const Triangles& scene, double voxel) {
  const std::optional<LatticeMesh> proxy = outward_scene(scene, {}, frame_of(scene, voxel));
  REQUIRE(proxy);
  MemorySource source(scene);
  const CheckReport report = check_proxy(indexed(*proxy), &source);
  CHECK(report.sound());
  CHECK(report.encloses());
  return *proxy;
}

bool has_none(const Triangles& scene, double voxel) {
  return !outward_scene(scene, {}, frame_of(scene, voxel));
}

/// A ring with a square section: each of its inner corners is a saddle.
Triangles square_ring() {
  Triangles scene;
  const auto quad = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    scene.push_back({a, b, c});
    scene.push_back({a, c, d});
  };
  const std::array<Vec3d, 4> out{Vec3d{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
      in{Vec3d{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}};
  const Vec3d up{0, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    quad(out[i], out[j], out[j] + up, out[i] + up);
    quad(in[j], in[i], in[i] + up, in[j] + up);
    quad(out[i] + up, out[j] + up, in[j] + up, in[i] + up);
    quad(out[j], out[i], in[i], in[j]);
  }
  return scene;
}

/// A sphere with a vertex that is pushed over its neighbours.
Triangles folded_sphere() {
  Triangles scene;
  add_sphere(scene, {0, 0, 0}, 1, 24);
  const Vec3d from = scene[scene.size() / 2][0];
  const Vec3d to = scene[scene.size() / 2][1];
  for (TriangleD& t : scene) {
    for (Vec3d& p : t) {
      if (p == from) p = to + 0.3 * (to - from);
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("a closed scene is enclosed by its own surface, with no face more") {
  Triangles scene;
  SECTION("a box") {
    add_box(scene, {0, 0, 0}, {1, 2, 3});
  }
  SECTION("a sphere") {
    add_sphere(scene, {0, 0, 0}, 1, 16);
  }
  SECTION("a ring with saddles") {
    scene = square_ring();
  }
  SECTION("two boxes apart") {
    add_box(scene, {0, 0, 0}, {1, 1, 1});
    add_box(scene, {1.5, 0, 0}, {2, 1, 1});
  }
  SECTION("far from the origin") {
    add_sphere(scene, {6e6, -6e6, 100}, 1, 16);
  }
  SECTION("read inside out") {
    add_box(scene, {0, 0, 0}, {1, 1, 1});
    turn_inside_out(scene, 0);
  }
  const LatticeMesh proxy = proven(scene, 0.02);
  CHECK(proxy.triangles.size() == scene.size());
}

TEST_CASE("each vertex moves by a few lattice units only") {
  Triangles scene;
  add_sphere(scene, {0, 0, 0}, 1, 16);
  const LatticeMesh proxy = proven(scene, 0.02);
  const double unit = proxy.frame.voxel / kLatticePerVoxel;
  for (const LatticeCoord& v : proxy.vertices) CHECK(length(proxy.frame.world(v)) < 1 + 5 * unit);
}

TEST_CASE("shells within others are left out") {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {3, 3, 3});
  const std::size_t cavity = scene.size();
  add_box(scene, {1, 1, 1}, {2, 2, 2});
  SECTION("a solid within a solid") {}
  SECTION("a cavity") {
    turn_inside_out(scene, cavity);
  }
  CHECK(proven(scene, 0.02).triangles.size() == 12);
}

TEST_CASE("a place where the scene folds over itself gets a tent") {
  const Triangles scene = folded_sphere();
  const LatticeMesh proxy = proven(scene, 0.1);
  CHECK(proxy.triangles.size() < scene.size());
}

TEST_CASE("a scene that bounds no solid has no such proxy") {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  SECTION("a hole") {
    scene.pop_back();
  }
  SECTION("a wall twice") {
    scene.push_back(scene.front());
  }
  SECTION("parts that overlap") {
    add_box(scene, {0.5, 0.5, 0.5}, {2, 2, 2});
  }
  SECTION("parts that touch") {
    add_box(scene, {1, 0, 0}, {2, 1, 1});
  }
  SECTION("parts nearer than the lattice can tell") {
    add_box(scene, {1.0001, 0, 0}, {2, 1, 1});
  }
  SECTION("nothing") {
    scene = {TriangleD{}};
  }
  CHECK(has_none(scene, 0.02));
}

}  // namespace bp::test
