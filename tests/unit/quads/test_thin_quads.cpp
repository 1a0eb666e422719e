#include <atomic>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/quads/thin_quads.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kThinBox{{0, 0, 0}, {40, 44, 70}};

/// Two slanted legs below a block; its own mirror image across x = 20.
bool legs(VoxelCoord p) {
  const std::int32_t x = std::abs(2 * p.x - 39);
  if (p.z >= 44) return p.y < 30;
  return x > 8 + (44 - p.z) / 3 && x < 22 + (44 - p.z) / 3 && p.y > 6 + p.z / 8 && p.y < 18 + p.z / 8;
}

}  // namespace

TEST_CASE("thinned cages hold the voxels, have at most their faces, and mirror each other", "[quads]") {
  const std::uint64_t faces = GENERATE(160, 400);
  const std::optional<MirrorPlane> plane = GENERATE(std::optional<MirrorPlane>(), std::optional<MirrorPlane>({0, 20}));
  const Thinning thinning = GENERATE(Thinning::strips, Thinning::singles);
  CAPTURE(faces, plane.has_value(), int(thinning));
  MemoryShelf shelf;
  fill_shelf(shelf, kThinBox, legs);
  const EnclosedVoxels enclosed(shelf);
  const CellQuads cubes = cube_quads(shelf, {}, 3, plane);
  REQUIRE(cubes.mesh.triangles.size() > faces);
  const CellQuads thin = thinned(cubes, enclosed, faces, plane, thinning).cage;
  REQUIRE(!thin.mesh.triangles.empty());
  CHECK(thin.mesh.triangles.size() <= faces);
  CHECK(thin.mesh.triangles.size() >= faces / 2);
  CHECK(2 * thin.mesh.quads.size() == thin.mesh.triangles.size());
  check_proxy(thin.mesh, kThinBox, legs);
  REQUIRE(thin.mate.size() == (plane ? thin.mesh.vertices.size() : 0));
  for (std::size_t v = 0; v < thin.mate.size(); ++v)
    CHECK(thin.mesh.vertices[thin.mate[v]] == plane->mirrored(thin.mesh.vertices[v]));
}

TEST_CASE("cubes that cannot be thinned to the faces give no cage", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kThinBox, legs);
  const EnclosedVoxels enclosed(shelf);
  CHECK(thinned(cube_quads(shelf, {}, 8, std::nullopt), enclosed, 8, std::nullopt, Thinning::strips)
            .cage.mesh.triangles.empty());
}

namespace {

/// 125 cubes of 6 voxels that stand apart. A closed part has at least 6 quads.
bool crumbs(VoxelCoord p) {
  return p.x % 12 < 6 && p.y % 12 < 6 && p.z % 12 < 6;
}

}  // namespace

TEST_CASE("thinning does not begin where parts need more quads than are wanted", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {60, 60, 60}}, crumbs);
  const EnclosedVoxels enclosed(shelf);
  const CellQuads cubes = cube_quads(shelf, {}, 3, std::nullopt);
  REQUIRE(cubes.mesh.quads.size() >= 125 * 24);
  std::vector<std::uint64_t> stages;
  const auto steps = [&](std::uint64_t done, std::uint64_t total) {
    CHECK(done < total);
    stages.push_back(done);
  };
  for (const Thinning thinning : {Thinning::strips, Thinning::singles}) {
    stages.clear();
    const Thinned thin = thinned(cubes, enclosed, 200, std::nullopt, thinning, steps);
    CHECK(thin.is_hopeless);
    CHECK(thin.cage.mesh.triangles.empty());
    CHECK(stages.empty());
  }
}

TEST_CASE("thinning ends when it is asked to stop", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kThinBox, legs);
  const EnclosedVoxels enclosed(shelf);
  std::atomic<bool> stop = false;
  WorkArena arena(1, &stop);
  CHECK_THROWS_AS(arena.run([&] {
    (void)thinned(cube_quads(shelf, {}, 3, std::nullopt), enclosed, 160, std::nullopt, Thinning::strips,
                  [&](std::uint64_t, std::uint64_t) { stop = true; });
  }),
                  Cancelled);
}
