#include <list>

#include "lib/enclosed/enclosed_voxels.h"
#include "lib/exact/predicates.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Small or large; every third with corners of voxels only, so that it touches cubes.
Tetrahedron any_tetrahedron(RandomLattice& random) {
  const bool aligned = random.between(0, 2) == 0;
  const std::int64_t size = aligned ? random.between(1, 12) : random.between(1, 800);
  const std::int64_t unit = aligned ? kLatticePerVoxel : 1;
  const LatticeCoord origin = random.point(-16 * kLatticePerVoxel / unit, 8 * kLatticePerVoxel / unit);
  Tetrahedron t;
  for (LatticeCoord& p : t) p = (origin + random.point(0, size)) * unit;
  return t;
}

void add_voxel(MemoryShelf& shelf, VoxelCoord v) {
  BitBox bits({{v.x & ~63, v.y & ~63, v.z & ~63}, {(v.x & ~63) + 64, (v.y & ~63) + 64, (v.z & ~63) + 64}});
  load_voxels(shelf, bits);
  bits.row(v.y, v.z)[0] |= std::uint64_t(1) << (v.x & 63);
  store_voxels(bits, shelf);
}

/// Four planes of the tetrahedron at once: p is strictly inside.
bool holds_inside(const Tetrahedron& t, const LatticeCoord& p) {
  const int turn = orient3d(t[0], t[1], t[2], t[3]);
  return turn != 0 && orient3d(t[0], t[1], t[2], p) == turn && orient3d(t[0], t[3], t[1], p) == turn &&
         orient3d(t[1], t[3], t[2], p) == turn && orient3d(t[2], t[3], t[0], p) == turn;
}

}  // namespace

TEST_CASE("a set of voxels allows what each of its voxels allows, and says which is in the way", "[quick][meshing]") {
  RandomLattice random(7);
  MemoryShelf shelf;
  std::vector<VoxelCoord> voxels;
  std::list<MemoryShelf> shelves;
  std::list<EnclosedVoxels> alone;  // each voxel by itself
  for (int i = 0; i < 60; ++i) {    // sparse, so that all are boundary; around the origin, in several bricks
    voxels.push_back({std::int32_t(random.between(-10, 9)), std::int32_t(random.between(-10, 9)),
                      std::int32_t(random.between(-10, 9))});
    add_voxel(shelf, voxels.back());
    MemoryShelf& one = shelves.emplace_back();
    add_voxel(one, voxels.back());
    alone.emplace_back(one);
  }
  const EnclosedVoxels all(shelf);
  int refused = 0;
  Blocker last;  // of another tetrahedron
  for (int i = 0; i < 4000; ++i) {
    const Tetrahedron t = any_tetrahedron(random);
    const auto allowed = [&](const EnclosedVoxels& e) { return e.allows({}, {{t}}, nullptr); };
    Blocker blocker;
    const bool free = all.allows({}, {{t}}, &blocker);
    CAPTURE(i);
    REQUIRE(free == std::all_of(alone.begin(), alone.end(), allowed));
    REQUIRE((blocker.count == 8) == !free);
    Blocker hint = last, own = blocker;
    REQUIRE(all.allows({}, {{t}}, &hint) == free);
    REQUIRE(all.allows({}, {{t}}, &own) == free);
    if (!free) last = blocker;
    refused += !free;
  }
  CHECK(refused > 200);
}

TEST_CASE("a tetrahedron that holds a point of a voxel is refused, one beside the voxel is not", "[quick][meshing]") {
  RandomLattice random(8);
  MemoryShelf shelf;
  add_voxel(shelf, {-1, 3, 63});
  const EnclosedVoxels voxel(shelf);
  const LatticeCoord low{-kLatticePerVoxel, 3 * kLatticePerVoxel, 63 * kLatticePerVoxel};
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    Tetrahedron t;
    for (LatticeCoord& p : t) p = low + random.point(-100, 164);
    bool held = false;
    for (int k = 0; k < 40; ++k) held |= holds_inside(t, low + random.point(1, kLatticePerVoxel - 1));
    if (held) CHECK_FALSE(voxel.allows({}, {{t}}, nullptr));
    refused += held;
    const int axis = int(random.between(0, 2));
    for (LatticeCoord& p : t) p[axis] = std::min(p[axis], low[axis]);  // touches it at most
    CHECK(voxel.allows({}, {{t}}, nullptr));
  }
  CHECK(refused > 200);
}

TEST_CASE("a tetrahedron from outside is allowed by a solid of voxels as by each of its voxels, inner ones too",
          "[quick][meshing]") {
  RandomLattice random(9);
  constexpr std::int64_t kEdge = 7;
  MemoryShelf shelf;
  std::list<MemoryShelf> shelves;
  std::list<EnclosedVoxels> alone;
  for (std::int32_t i = 0; i < kEdge * kEdge * kEdge; ++i) {
    const VoxelCoord v{i % std::int32_t(kEdge), i / std::int32_t(kEdge) % std::int32_t(kEdge),
                       i / std::int32_t(kEdge * kEdge)};
    if (random.between(0, 9) < 2) continue;  // holes and concave corners
    add_voxel(shelf, v);
    MemoryShelf& one = shelves.emplace_back();
    add_voxel(one, v);
    alone.emplace_back(one);
  }
  const EnclosedVoxels all(shelf);
  int refused = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::int64_t unit = i % 2 == 0 ? kLatticePerVoxel : 1, top = kEdge * kLatticePerVoxel / unit;
    Tetrahedron t;
    for (LatticeCoord& p : t) p = random.point(-top / 4, top + top / 4) * unit;
    for (std::size_t k = 0; k < 3; ++k) t[k].z = std::max(t[k].z, top * unit);  // the old face, above or on it
    const bool free = all.allows({}, {{t}}, nullptr);
    CAPTURE(i);
    REQUIRE(free == std::all_of(alone.begin(), alone.end(),
                                [&](const EnclosedVoxels& e) { return e.allows({}, {{t}}, nullptr); }));
    refused += !free;
  }
  CHECK(refused > 1000);
  CHECK(refused < 5500);
}

TEST_CASE("no point of a face that is called near is farther by more than the diagonal of a voxel",
          "[quick][meshing]") {
  constexpr double kVoxel = kLatticePerVoxel, kRounding = 8;
  std::mt19937 random(7);
  const auto number = [&](double low, double high) { return low + (high - low) * double(random() % 100000) / 1e5; };
  double farthest = 0;
  int near = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<VoxelCoord> voxels(std::size_t(1) << i % 4);
    for (VoxelCoord& v : voxels) v = {int(random() % 12), int(random() % 12), int(random() % 12)};
    MemoryShelf shelf;
    fill_shelf(shelf, {{-64, -64, -64}, {64, 64, 64}},
               [&](VoxelCoord p) { return std::find(voxels.begin(), voxels.end(), p) != voxels.end(); });
    const EnclosedVoxels all(shelf);
    for (int k = 0; k < 200; ++k) {
      const double distance = number(4, 16) * kVoxel;
      const LatticeCoord at = rounded({number(-6, 18) * kVoxel, number(-6, 18) * kVoxel, number(-6, 18) * kVoxel});
      const double size = number(0.05, 0.6) * distance;
      std::array<LatticeCoord, 3> corners;
      for (LatticeCoord& p : corners) p = at + rounded({number(0, size), number(0, size), number(0, size)});
      if (!all.is_near(std::array<NewFace, 1>{{{{}, corners}}}, distance)) continue;
      ++near;
      for (const LatticeCoord& p : corners) {
        double least = 1e300;
        for (const VoxelCoord& v : voxels) {
          const LatticeCoord low = LatticeCoord{v.x, v.y, v.z} * kLatticePerVoxel;
          Vec3d away{};
          for (int a = 0; a < 3; ++a)
            away[std::size_t(a)] = double(std::max({std::int64_t(0), low[a] - p[a], p[a] - low[a] - kLatticePerVoxel}));
          least = std::min(least, length(away));
        }
        REQUIRE(least <= distance + std::sqrt(3.0) * kVoxel + kRounding);
        farthest = std::max(farthest, least / distance);
      }
    }
  }
  CHECK(near > 1000);
  CHECK(farthest > 1.1);  // it does happen
}

TEST_CASE("a face is near a set of voxels if no point of it is far, whatever its corners are", "[quick][meshing]") {
  constexpr std::int64_t kVoxel = kLatticePerVoxel;
  MemoryShelf shelf;
  fill_shelf(shelf, {{-64, -64, -64}, {64, 64, 64}}, [](VoxelCoord p) {  // a plate with a gap 24 voxels wide
    return p.z == 0 && std::abs(p.x) < 40 && std::abs(p.y) < 40 && (p.x < 0 || p.x >= 24);
  });
  const EnclosedVoxels plate(shelf);
  const auto face = [&](std::int64_t x0, std::int64_t x1, double height) {
    const auto z = std::int64_t(height * kVoxel);
    return std::array<NewFace, 1>{
        {{{}, {{{x0 * kVoxel, -30 * kVoxel, z}, {x1 * kVoxel, -30 * kVoxel, z}, {x1 * kVoxel, 30 * kVoxel, z}}}}}};
  };
  CHECK(plate.is_near(face(-39, -1, 3), 2.5 * kVoxel));  // the top of the plate is at 1
  CHECK_FALSE(plate.is_near(face(-39, -1, 3), 1.5 * kVoxel));
  CHECK_FALSE(plate.is_near(face(-39, 39, 3), 8 * kVoxel));    // over the gap
  CHECK(plate.is_near(face(-39, 39, 3), 13 * kVoxel));         // half of it, and the height
  CHECK_FALSE(plate.is_near(face(200, 240, 3), 13 * kVoxel));  // where no brick is
}
