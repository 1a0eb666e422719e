#include "lib/check/check_proxy.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

LodOptions around(const Triangles& scene) {
  LodOptions options;
  options.context.make_shelf = memory_shelves();
  options.enclose = Enclose::scene, options.scene = scene;
  return options;
}

}  // namespace

TEST_CASE("a scene that ends close to a side of doubled voxels lies within them", "[quick][pass][lod]") {
  constexpr double kBeside = 2.0 / 65536;  // of a voxel: more than voxels are grown by, less than doubled ones
  Triangles scene;
  add_box(scene, {0, 0, 0}, {40 - kBeside, 41 - kBeside, 42 - kBeside});
  add_box(scene, {0, 0, 0}, {240, 10, 10});
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 1);
  LodOptions options = around(scene);
  LodChain chain(solid.header, std::move(solid.shelf), backends, std::move(options));
  const LodLevel coarse = chain.make({0, 20, {}});
  CHECK(coarse.reductions > 0);
  MemorySource source(scene);
  CHECK(check_proxy(indexed(coarse.mesh), &source).holds());
}

TEST_CASE("another scene than that of the voxels is refused", "[quick][pass][lod]") {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {40, 41, 42});
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 1);
  LodOptions options = around(scene);
  options.scene[0][0] = {0, 0, 50};
  CHECK_THROWS_AS(LodChain(solid.header, std::move(solid.shelf), backends, std::move(options)), Error);
}

TEST_CASE("parts that take more faces than there are get a closing also where a scale of 0 was named",
          "[quick][pass][lod]") {
  Triangles scene;
  for (int i = 0; i < 3; ++i) add_box(scene, {4.0 * i, 0, 0}, {4.0 * i + 1, 1, 1});
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 0.25);
  LodChain chain(solid.header, std::move(solid.shelf), backends, around(scene));
  const LodLevel level = chain.make({8, 0, 0.0});
  CHECK(level.reached);
  CHECK(level.scale_world > 0);
  for (std::size_t i = 1; i < level.tried.size(); ++i) {  // nothing is made twice
    const TriedWay &a = level.tried[i - 1], &b = level.tried[i];
    CHECK((a.faces != b.faces || a.volume != b.volume || a.scale_world != b.scale_world));
  }
}

TEST_CASE("levels around triangles need no memory for distances to voxels", "[quick][pass][lod]") {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {10, 9, 8});
  const bool triangles = GENERATE(true, false);
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 0.125);
  LodOptions options = around(scene);
  options.context.memory.bytes = 20000;
  if (!triangles) options.enclose = Enclose::input;
  const auto make = [&] { LodChain(solid.header, std::move(solid.shelf), backends, std::move(options)); };
  if (triangles) {
    CHECK_NOTHROW(make());
  } else {
    CHECK_THROWS_AS(make(), Error);
  }
}

}  // namespace bp::test
