#include "lib/levels/detail/convex_voxels.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Voxels of a box of 100 that `solid` has.
struct Shelf : MemoryShelf {
  explicit Shelf(const Solid& solid) {
    VoxelSource source({{0, 0, 0}, {100, 100, 100}}, solid);
    for (Brick brick; source.read(brick);) put(brick.coord, brick.fill, brick.bits);
  }
};

bool ball(VoxelCoord p) {
  const std::int64_t x = p.x - 50, y = p.y - 50, z = p.z - 50;
  return x * x + y * y + z * z < 40 * 40;
}

}  // namespace

TEST_CASE("the hull of a convex solid holds no voxel besides its own", "[quick][levels][occluder]") {
  CHECK(voxels_beside_hull(Shelf([](VoxelCoord p) { return p.x > 3 && p.y > 60 && p.z < 90; })) <= 0);
  CHECK(voxels_beside_hull(Shelf(ball)) <= 0);
  CHECK(voxels_beside_hull(Shelf([](VoxelCoord p) { return p.x + 2 * p.y + 3 * p.z < 200; })) <= 0);
}

TEST_CASE("a notch and a second part are counted in the hull", "[quick][levels][occluder]") {
  const auto box = [](VoxelCoord p, std::int32_t from, std::int32_t to) { return p.x >= from && p.x < to; };
  const Shelf parts([&](VoxelCoord p) { return box(p, 0, 20) || box(p, 80, 100); });
  CHECK(voxels_beside_hull(parts) == Approx(60 * 100 * 100).epsilon(0.05));
  CHECK(count_voxels(parts) == 40 * 100 * 100);
  const Shelf notched([](VoxelCoord p) { return p.z < 50 || p.y < 30 || p.y >= 70; });
  CHECK(voxels_beside_hull(notched) == Approx(100 * 40 * 50).epsilon(0.2));
}
