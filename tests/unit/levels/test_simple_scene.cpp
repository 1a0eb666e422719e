#include "lib/check/check_proxy.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

/// A house of 16 triangles, whose roof juts out.
Triangles house() {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {4, 3, 2});
  const Vec3d low{-0.2, -0.2, 2}, low_far{4.2, -0.2, 2}, top{-0.2, 1.5, 3.2}, top_far{4.2, 1.5, 3.2};
  const Vec3d back{-0.2, 3.2, 2}, back_far{4.2, 3.2, 2};
  scene.push_back({low, low_far, top_far});
  scene.push_back({low, top_far, top});
  scene.push_back({back_far, back, top});
  scene.push_back({back_far, top, top_far});
  return scene;
}

struct LevelAndScale {
  LodLevel level;
  double first;  ///< the scale that is tried first
};

LevelAndScale level_of(const Triangles& scene, const LodTarget& target, double voxel = 0.02) {
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, voxel);
  solid.header.scene.triangles = scene.size();
  const double diagonal = solid.header.bounds.diagonal();
  LodOptions options;
  options.context.make_shelf = memory_shelves();
  options.enclose = Enclose::scene, options.scene = scene;
  LodChain chain(solid.header, std::move(solid.shelf), backends, options);
  const double first = first_scale({solid.header.frame.voxel, diagonal, chain.dense_faces()}, target, 0);
  return {chain.make(target), first};
}

/// Two plates of 12 triangles, one over the other; few faces need not show the gap.
Triangles plates() {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {10, 10, 0.2});
  add_box(scene, {0, 0, 0.6}, {10, 10, 0.8});
  return scene;
}

/// `n` treads, one after the other and each higher, that lie apart.
Triangles treads(int n) {
  Triangles scene;
  for (int k = 0; k < n; ++k) add_box(scene, {0.3 * k, 0, 0.2 * k}, {0.3 * k + 0.25, 1, 0.2 * k + 0.04});
  return scene;
}

}  // namespace

TEST_CASE("a level that may have all triangles of its scene may have more surface at a smaller scale",
          "[quick][pass][lod]") {
  const LodLevel level = level_of(plates(), {100, 0, {}}).level;
  CHECK(level.mesh.triangles.size() == 24);
  CHECK(level.error_world < 0.02);
}

TEST_CASE("a level whose spikes reach many scales is closed at twice the scale", "[quick][pass][lod]") {
  const Triangles scene = treads(9);
  constexpr double voxel = 0.019;  // the first scale gives as many faces as are allowed, and one of them is a spike
  const LevelAndScale made = level_of(scene, {106, 0, {}}, voxel);
  CHECK(made.level.scale_world == Approx(2 * made.first));
  CHECK(made.level.attempts == 1);  // not for too many faces
  const LodLevel at_first = level_of(scene, {106, 0, made.first}, voxel).level;
  CHECK(at_first.scale_world == made.first);
  CHECK(made.level.error_world < 0.8 * at_first.error_world);
}

TEST_CASE("a level of a simple scene is closed at a smaller scale where it lies nearer then", "[quick][pass][lod]") {
  const Triangles scene = house();
  const LevelAndScale made = level_of(scene, {100, 0, {}});
  const LodLevel at_first = level_of(scene, {100, 0, made.first}).level;  // a scale that is named is taken as it is
  CHECK(at_first.scale_world == made.first);
  CHECK(made.level.scale_world < 0.3 * made.first);
  CHECK(made.level.error_world < 0.5 * at_first.error_world);
  CHECK(made.level.mesh.triangles.size() <= 100);
  MemorySource source(scene);
  CHECK(check_proxy(indexed(made.level.mesh), &source).holds());
}

TEST_CASE("a level that lies as near as its closing may is not closed at larger scales", "[quick][pass][lod]") {
  const LodLevel level = level_of(house(), {40000, 0, {}}).level;
  const auto closings =
      std::count_if(level.tried.begin(), level.tried.end(), [](const TriedWay& t) { return t.way == "closing"; });
  CHECK(closings <= 2);  // one of them where nothing is closed; five up to twice the scale of the budget
  CHECK(level.error_world < std::sqrt(3.0) * (level.scale_world + 0.02));
  CHECK(level.mesh.triangles.size() <= 4096);
}

}  // namespace bp::test
