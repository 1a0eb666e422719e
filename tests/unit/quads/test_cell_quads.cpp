#include <algorithm>

#include "lib/quads/cell_quads.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kBox{{0, 0, 0}, {40, 44, 70}};

/// Two legs and a bar with a hole; its own mirror image across x = 20.
bool shape(VoxelCoord p) {
  if (p.z < 40) return std::abs(2 * p.x - 39) > 12 && p.y > 12 && p.y < 26;
  return p.y < 30 && !(p.z > 50 && p.z < 64 && std::abs(2 * p.x - 39) < 20);
}

}  // namespace

TEST_CASE("boxes of quads hold the voxels, have their faces, and mirror each other", "[quick][quads]") {
  const std::uint64_t faces = GENERATE(20, 60, 200, 600);
  const std::optional<MirrorPlane> plane =
      GENERATE(std::optional<MirrorPlane>(), std::optional<MirrorPlane>({0, 20}), std::optional<MirrorPlane>({1, 17}));
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, shape);
  const CellQuads cage = cell_quads(shelf, {}, faces, plane);
  CHECK(cage.mesh.triangles.size() <= faces);
  CHECK(cage.mesh.triangles.size() >= std::min<std::size_t>(faces, 200) / 2);
  CHECK(2 * cage.mesh.quads.size() == cage.mesh.triangles.size());
  check_proxy(cage.mesh, kBox, shape);
  REQUIRE(cage.mate.size() == (plane ? cage.mesh.vertices.size() : 0));
  for (std::size_t v = 0; v < cage.mate.size(); ++v)
    CHECK(cage.mesh.vertices[cage.mate[v]] == plane->mirrored(cage.mesh.vertices[v]));
}

TEST_CASE("fewer faces than those of a box give no cage", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, shape);
  CHECK(cell_quads(shelf, {}, 12, std::nullopt).mesh.triangles.size() == 12);
  CHECK(cell_quads(shelf, {}, 11, std::nullopt).mesh.triangles.empty());
  CHECK(cell_quads(shelf, {}, 19, MirrorPlane{0, 20}).mesh.triangles.empty());
}
