#include "lib/check/check_proxy.h"
#include "lib/levels/cage_voxels.h"
#include "lib/levels/lod_chain.h"
#include "lib/quads/quads.h"
#include "lib/volume/dilate_ball.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

using namespace bp;
using namespace bp::test;

namespace {

Triangles legs() {
  Triangles scene;
  add_box(scene, {0.3, 0.1, 8.2}, {30.7, 12.4, 17.9});
  for (int i = 0; i < 4; ++i) {
    const Vec3d lo{1.0 + 24 * (i % 2), 1.5 + 6 * (i / 2), 0.4};
    add_box(scene, lo, {lo[0] + 3.1, lo[1] + 2.3, 9});
  }
  return scene;
}

PassContext context() {
  PassContext context;
  context.make_shelf = memory_shelves();
  return context;
}

CheckReport check_at(const IndexedMesh& mesh, const Triangles& scene, double margin) {
  MemorySource source(scene);
  CheckOptions options;
  options.margin_world = margin;
  return check_proxy(mesh, &source, options);
}

}  // namespace

TEST_CASE("a cage keeps its margin from the scene, over either diagonal of its quads", "[quick][levels]") {
  const double margin = GENERATE(0.05, 0.5, 1.3);
  const Triangles scene = legs();
  Voxelized voxels = voxelized(scene, 0.25);
  VoxelizedScene grown{voxels.header, std::move(voxels.shelf), {}};
  add_margin(grown, margin, context());
  Backends backends = plain_backends(2);
  LodOptions options;
  options.context = context();
  options.cage.emplace();
  LodChain chain(grown.header, std::move(grown.solid), backends, options);
  LatticeMesh cage = chain.make({200, 0, {}, 1}).mesh;
  CHECK(cage.triangles.size() <= 200);
  CHECK_FALSE(cage.quads.empty());
  CHECK(check_at(indexed(cage), scene, margin).holds());
  CHECK(check_at(indexed(cage), scene, 20).answer() == Answer::refuted);
  for (const auto& pair : cage.quads) {
    const auto other = across(quad_of(cage.triangles[pair[0]], cage.triangles[pair[1]]));
    for (std::size_t i = 0; i < 2; ++i) cage.triangles[pair[i]] = other[i];
  }
  CHECK(check_at(indexed(cage), scene, margin).holds());
}

TEST_CASE("a margin beyond the reach of dilation is refused", "[quick][levels]") {
  Voxelized voxels = voxelized(legs(), 0.25);
  VoxelizedScene scene{voxels.header, std::move(voxels.shelf), {}};
  CHECK_THROWS_AS(add_margin(scene, 0.25 * (kMostReach + 1), context()), Error);
}

TEST_CASE("growing by a margin tells its progress, and what memory it takes", "[quick][levels]") {
  Voxelized voxels = voxelized(legs(), 0.25);
  VoxelizedScene scene{voxels.header, std::move(voxels.shelf), {}};
  PassContext tells = context();
  std::uint64_t done = 0, total = 1;
  tells.progress = [&](const char*, const char*, std::uint64_t d, std::uint64_t t) { done = d, total = t; };
  tells.memory.bytes = 1 << 20;
  CHECK_THROWS_AS(add_margin(scene, 5, tells), NeedsMemory);
  tells.memory.bytes = 64 << 20;
  add_margin(scene, 5, tells);
  CHECK(done == total);
}
