#include <random>

#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/geometry/triangle_parts.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/memory_store.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

/// Returns whether a point lies where the house of town() stands on its slab, which nobody sees.
bool is_hidden(const Vec3d& p) {
  return p[1] == 2 && p[0] > 60 && p[0] < 75 && p[2] > 70 && p[2] < 82;
}

/// Largest distance of points of `from` that are not hidden to `to`: along all edges, and all over the area. Every
/// triangle is asked.
double sampled_distance(const std::vector<TriangleD>& from, const std::vector<TriangleD>& to) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  double area = 0, largest = 0;
  for (const TriangleD& t : from) area += area_of(t);
  const auto meet = [&](const Vec3d& p) {
    if (is_hidden(p)) return;
    double nearest = HUGE_VAL;
    for (const TriangleD& t : to) nearest = std::min(nearest, distance_squared(p, t));
    largest = std::max(largest, std::sqrt(nearest));
  };
  for (const TriangleD& t : from) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int i = 0; i < 200; ++i) {
        Vec3d p;
        for (std::size_t a = 0; a < 3; ++a) p[a] = t[k][a] + i / 200.0 * (t[(k + 1) % 3][a] - t[k][a]);
        meet(p);
      }
    }
    for (int i = 0; i < 4000 * area_of(t) / area; ++i) {
      double u = uniform(random), v = uniform(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      meet({t[0][0] + u * (t[1][0] - t[0][0]) + v * (t[2][0] - t[0][0]),
            t[0][1] + u * (t[1][1] - t[0][1]) + v * (t[2][1] - t[0][1]),
            t[0][2] + u * (t[1][2] - t[0][2]) + v * (t[2][2] - t[0][2])});
    }
  }
  return largest;
}

/// A large slab with a house on it, or alone: faces of hundreds of voxels.
Triangles town(bool house) {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {160, 2, 180});
  if (house) add_box(scene, {60, 2, 70}, {75, 17, 82});
  return scene;
}

LodLevel level_of(const Triangles& scene, double voxel, const LodTarget& target, Enclose enclose) {
  Backends backends = plain_backends(2);
  LodOptions options;
  options.context.make_shelf = memory_shelves();
  options.enclose = enclose;
  if (enclose == Enclose::scene) options.scene = scene;
  Voxelized solid = voxelized(scene, voxel);
  LodChain chain(solid.header, std::move(solid.shelf), backends, std::move(options));
  return chain.make(target);
}

}  // namespace

TEST_CASE("the error of a level with large flat faces is no larger than that of one with small faces",
          "[quick][pass][lod]") {
  const bool house = GENERATE(false, true);
  const double voxel = 0.5;
  const Triangles scene = town(house);
  const LodLevel level = level_of(scene, voxel, {0, 4, {}}, Enclose::input);
  const double there = sampled_distance(world_triangles(level.mesh), scene);
  CAPTURE(house, level.mesh.triangles.size(), there);
  CHECK(level.mesh.triangles.size() < 100);
  CHECK(level.error_world >= there);
  CHECK(level.error_world <= there + 2 * voxel);
  CHECK(level.error_world <= 4);
}

TEST_CASE("the error of a level that encloses the scene's triangles is the distance to them", "[quick][pass][lod]") {
  const double voxel = 0.5;
  Triangles scene = town(true);
  if (GENERATE(false, true)) add_sphere(scene, {30, 20, 40}, 12, 12);
  for (const LodTarget& target : {LodTarget{0, 4, {}}, LodTarget{40, 0, 3.0}}) {
    const LodLevel level = level_of(scene, voxel, target, Enclose::scene);
    const double there = sampled_distance(world_triangles(level.mesh), scene);
    CAPTURE(target.faces, level.mesh.triangles.size(), there);
    CHECK(level.error_world >= there);
    CHECK(level.error_world <= 1.05 * there + 0.07 * voxel);  // sampling misses the farthest point
  }
}

TEST_CASE("errors do not depend on the number of threads", "[quick][pass][lod]") {
  Triangles scene = town(true);
  add_sphere(scene, {80, 60, 90}, 40, 24);
  const auto errors = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> all;
    for (const Enclose enclose : {Enclose::input, Enclose::scene}) {
      const LodLevel level = level_of(scene, 2, {3000, 0, {}}, enclose);
      CHECK(level.mesh.triangles.size() > 1000);  // some pieces of work
      all.push_back(level.error_world);
    }
    return all;
  };
  CHECK(errors(1) == errors(4));
}

TEST_CASE("what measures a level takes no more memory than what enclosed the scene", "[quick][pass][lod]") {
  CHECK(TriangleBvh::bytes_needed(1000000) <= 1000000 * EnclosedTriangles::kBytesEach);
}

}  // namespace bp::test
