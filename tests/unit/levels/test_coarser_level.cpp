#include "lib/check/check_proxy.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

namespace bp::test {

TEST_CASE("a coarser level follows from the finer one while its parts have faces enough", "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
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
