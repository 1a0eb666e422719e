#include "lib/enclosed/enclosed_voxels.h"
#include "lib/quads/cell_quads.h"
#include "lib/quads/limb_cage.h"
#include "lib/quads/limbs.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kCombBox{{0, 0, 0}, {100, 12, 70}};

/// A beam with five thin legs. `web`: how far the gaps between them are filled from the beam on.
bool comb(VoxelCoord p, std::int32_t web) {
  const bool leg = p.x % 20 >= 8 && p.x % 20 < 14 && p.y >= 3 && p.y < 9;
  return p.z >= 56 || (p.z >= 2 && leg) || (p.z >= 56 - web && p.y >= 3 && p.y < 9 && p.x >= 8 && p.x < 94);
}

/// Legs that run across the axes: they are joined where cubes are large.
bool slanted(VoxelCoord p) {
  if (p.z >= 56) return true;
  if (p.z < 2 || p.y < 2 || p.y > 9) return false;
  const std::int32_t x = (p.x + p.z / 2) % 11;
  return x < 4 && p.x >= 10 && p.x < 90;
}

CellQuads cubes_around(std::int32_t web) {
  MemoryShelf shelf;
  fill_shelf(shelf, kCombBox, [&](VoxelCoord p) { return comb(p, web); });
  return cube_quads(shelf, {}, 2, std::nullopt);
}

}  // namespace

TEST_CASE("limbs are counted, and those that webs join", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kCombBox, [](VoxelCoord p) { return comb(p, 0); });
  const Limbs limbs(shelf);
  CHECK(limbs.count() >= 5);  // the ends of the beam may count, too
  CHECK(limbs.count() <= 9);
  CHECK(limbs.joined(cubes_around(0).mesh).empty());
  CHECK(limbs.joined(cubes_around(12).mesh).empty());  // webs at the roots of limbs leave them apart
  const std::vector<LatticeCoord> joined = limbs.joined(cubes_around(52).mesh);
  CHECK(joined.size() >= 5);
  for (const LatticeCoord& p : joined) CHECK(p.z < 20 * kLatticePerVoxel);
}

TEST_CASE("a ball has no limbs that could be joined", "[quick][quads]") {
  MemoryShelf shelf;
  const VoxelBox box{{0, 0, 0}, {60, 60, 60}};
  fill_shelf(shelf, box, [](VoxelCoord p) {
    const std::int32_t x = 2 * p.x - 59, y = 2 * p.y - 59, z = 2 * p.z - 59;
    return x * x + y * y + z * z < 59 * 59;
  });
  const Limbs limbs(shelf);
  CHECK(limbs.joined(cube_quads(shelf, {}, 4, std::nullopt).mesh).empty());
}

TEST_CASE("a cage keeps limbs apart that boxes join, and holds the voxels", "[quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kCombBox, slanted);
  const Limbs limbs(shelf);
  const EnclosedVoxels enclosed(shelf);
  CageLimbs result;
  const LatticeMesh cage = cage_with_limbs(shelf, {}, enclosed, 700, std::nullopt, result);
  CHECK(cage.triangles.size() <= 700);
  CHECK(result.count == limbs.count());
  CHECK(result.joined.size() == limbs.joined(cage).size());
  CHECK(result.joined.size() < limbs.joined(cell_quads(shelf, {}, 700, std::nullopt).mesh).size());
  check_proxy(cage, kCombBox, slanted);
}
