#include "lib/check/check_proxy.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

void add_turned_box(Triangles& scene, const Vec3d& lo, const Vec3d& hi) {
  const std::size_t first = scene.size();
  add_box(scene, lo, hi);
  for (std::size_t i = first; i < scene.size(); ++i) {
    for (Vec3d& p : scene[i]) p = {0.8 * p[0] - 0.6 * p[1], 0.6 * p[0] + 0.8 * p[1], p[2] + 0.3 * p[0]};
  }
}

}  // namespace

TEST_CASE("a coarser level follows from the finer one while its parts have faces enough", "[quick][pass][lod]") {
  Triangles scene;  // turned, so that no face of a voxel lies in its sides
  add_turned_box(scene, {0, 0, 0}, {8, 7, 6});
  add_turned_box(scene, {20, 0, 0}, {27, 9, 6});
  Backends backends = plain_backends(2);
  LodOptions options;
  options.context.make_shelf = memory_shelves();
  Voxelized solid = voxelized(scene, 0.25);
  LodChain chain(solid.header, std::move(solid.shelf), backends, options);
  const LodLevel fine = chain.make({600, 0, {}}), coarse = chain.make({110, 0, {}}), far = chain.make({30, 0, {}});
  CHECK(coarse.scale_world == fine.scale_world);  // of the budget it would be twice as large, or more
  CHECK(coarse.reached);
  CHECK(coarse.mesh.triangles.size() < fine.mesh.triangles.size());
  CHECK(far.scale_world > coarse.scale_world);  // 2 parts of 50 faces do not fit
  for (const LodLevel* level : {&fine, &coarse, &far}) {
    MemorySource source(scene);
    CHECK(check_proxy(indexed(level->mesh), &source).holds());
  }
}

}  // namespace bp::test
