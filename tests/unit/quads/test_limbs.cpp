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
  const Limbs limbs(shelf, shelf);
  CHECK(limbs.count() == 5);
  CHECK(limbs.fit(cubes_around(0).mesh).joined.empty());
  CHECK(limbs.fit(cubes_around(12).mesh).joined.empty());  // webs at the roots of limbs leave them apart
  const std::vector<LatticeCoord> joined = limbs.fit(cubes_around(52).mesh).joined;
  CHECK(joined.size() >= 5);
  for (const LatticeCoord& p : joined) CHECK(p.z < 20 * kLatticePerVoxel);
}

TEST_CASE("each part of a model has its limbs", "[quick][quads]") {
  MemoryShelf shelf;
  const auto two = [](VoxelCoord p, std::int32_t web) {
    return (p.z < 70 && comb(p, 0)) || (p.z >= 80 && comb({p.x, p.y, 149 - p.z}, 0)) ||
           (p.z >= 2 && p.z < 148 && p.x >= 8 && p.x < 8 + web && p.y >= 3 && p.y < 9);
  };
  const VoxelBox box{{0, 0, 0}, {100, 12, 150}};
  fill_shelf(shelf, box, [&](VoxelCoord p) { return two(p, 0); });
  const Limbs limbs(shelf, shelf);
  CHECK(limbs.count() == 10);
  CHECK(limbs.fit(cube_quads(shelf, {}, 1, std::nullopt).mesh).joined.empty());
  // Two backs that are joined leave all legs apart. A web over all legs does not.
  for (const std::int32_t web : {6, 86}) {
    MemoryShelf other;
    fill_shelf(other, box, [&](VoxelCoord p) { return two(p, web); });
    CHECK(limbs.fit(cube_quads(other, {}, 1, std::nullopt).mesh).joined.size() == (web == 6 ? 0 : 10));
  }
}

TEST_CASE("a limb is longer than its section is wide", "[quick][quads]") {
  const auto count = [](VoxelCoord size, const auto& inside) {
    MemoryShelf shelf;
    fill_shelf(shelf, {{0, 0, 0}, size}, inside);
    return Limbs(shelf, shelf).count();
  };
  const auto within = [](VoxelCoord p, const VoxelBox& box) { return box.contains(p); };
  SECTION("balls, boxes, plates and sheds have none") {
    CHECK(count({60, 60, 60}, [](VoxelCoord p) {
            const std::int32_t x = 2 * p.x - 59, y = 2 * p.y - 59, z = 2 * p.z - 59;
            return x * x + y * y + z * z < 59 * 59;
          }) == 0);
    CHECK(count({60, 60, 60}, [](VoxelCoord) { return true; }) == 0);
    CHECK(count({90, 50, 30}, [](VoxelCoord) { return true; }) == 0);
    CHECK(count({100, 80, 4}, [](VoxelCoord) { return true; }) == 0);
    CHECK(count({80, 80, 80}, [](VoxelCoord p) {  // a plate on edge, turned by 45 degrees
            return std::abs(p.x + p.y - 79) + std::abs(p.x - p.y) < 78 && p.z < 10;
          }) == 0);
    CHECK(count({90, 60, 80}, [](VoxelCoord p) { return p.z < 40 || std::abs(2 * p.y - 59) < 2 * (80 - p.z); }) == 0);
  }
  SECTION("a peg on a cube is one, and a knob is none") {
    const auto peg = [&](std::int32_t top) {
      return count({60, 60, top}, [&](VoxelCoord p) { return p.z < 60 || within(p, {{24, 24, 60}, {33, 33, top}}); });
    };
    CHECK(peg(84) == 1);
    CHECK(peg(67) == 0);
  }
  SECTION("a table has its legs, long or short") {
    for (const std::int32_t leg : {18, 50}) {
      CAPTURE(leg);
      CHECK(count({100, 60, leg + 6},
                  [&](VoxelCoord p) { return p.z >= leg || ((p.x < 7 || p.x >= 93) && (p.y < 7 || p.y >= 53)); }) == 4);
    }
  }
  SECTION("a figure has a head, arms and legs") {
    CHECK(count({70, 14, 110}, [&](VoxelCoord p) {
            return within(p, {{25, 2, 45}, {45, 12, 85}}) || within(p, {{32, 4, 85}, {38, 10, 90}}) ||
                   within(p, {{30, 2, 90}, {40, 12, 110}}) || within(p, {{0, 4, 74}, {70, 10, 82}}) ||
                   within(p, {{25, 3, 0}, {33, 11, 45}}) || within(p, {{37, 3, 0}, {45, 11, 45}});
          }) == 5);
  }
}

TEST_CASE("a margin closes holes of a model, and leaves its gaps", "[quick][quads]") {
  const auto shell = [](VoxelCoord p) {  // hollow, with a hole; its limbs are 2 voxels apart
    const VoxelBox body{{2, 2, 2}, {62, 42, 42}}, first{{20, 18, 42}, {26, 24, 90}}, second{{28, 18, 42}, {34, 24, 90}};
    const bool hole = p.x == 2 && p.y >= 20 && p.y < 22;
    return (body.contains(p) && !body.grown(-1).contains(p) && !hole) || first.contains(p) || second.contains(p);
  };
  const VoxelBox box{{0, 0, 0}, {64, 44, 92}};
  MemoryShelf model, grown;
  fill_shelf(model, box, shell);
  fill_shelf(grown, box, [&](VoxelCoord p) {
    bool near = false;
    for_each(VoxelBox{p, p + VoxelCoord{1, 1, 1}}.grown(1), [&](VoxelCoord q) { near = near || shell(q); });
    return near;
  });
  CHECK(Limbs(model, grown).count() == 2);
  CHECK(Limbs(grown, grown).count() == 1);
}

TEST_CASE("a cage keeps limbs apart that boxes join, and holds the voxels", "[quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kCombBox, slanted);
  const Limbs limbs(shelf, shelf);
  const EnclosedVoxels enclosed(shelf);
  CageFit fit;
  const LatticeMesh cage = cage_with_limbs(shelf, {}, enclosed, 700, std::nullopt, limbs, fit);
  CHECK(cage.triangles.size() <= 700);
  CHECK(fit.joined.size() == limbs.fit(cage).joined.size());
  CHECK(fit.joined.size() < limbs.fit(cell_quads(shelf, {}, 700, std::nullopt).mesh).joined.size());
  check_proxy(cage, kCombBox, slanted);
}

TEST_CASE("of cages with as many limbs apart, the one that reaches less far fits better", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kCombBox, [](VoxelCoord p) { return comb(p, 0); });
  const Limbs limbs(shelf, shelf);
  const LatticeMesh near = cubes_around(0).mesh;
  LatticeMesh spike = near;  // one corner of the beam is drawn out
  const auto far = std::max_element(spike.vertices.begin(), spike.vertices.end(),
                                    [](const auto& a, const auto& b) { return a.x + a.y + a.z < b.x + b.y + b.z; });
  for (int i = 0; i < 3; ++i) (*far)[i] += 40 * kLatticePerVoxel;
  CHECK(limbs.fit(near).reach <= 6);
  CHECK(limbs.fit(spike).reach >= 60);
  CHECK(limbs.fit(near).is_better_than(limbs.fit(spike)));
  CHECK_FALSE(limbs.fit(spike).is_better_than(limbs.fit(near)));
  CHECK(limbs.fit(near).is_better_than(limbs.fit(cubes_around(52).mesh)));
}
