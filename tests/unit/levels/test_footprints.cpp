#include "lib/levels/footprints.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("parts that stand apart are told with what they hide", "[quick][occluder]") {
  constexpr VoxelBox kLeft{{0, 0, 0}, {20, 12, 30}}, kRight{{70, 30, 10}, {100, 60, 20}};
  const Solid houses = [&](VoxelCoord p) {
    const bool corner = p.x == 20 && p.z == 30;  // touches the left one at an edge
    return kLeft.contains(p) || kRight.contains(p) || (corner && p.y == 50);
  };
  const auto shelf_of = [](const Solid& solid) {
    auto shelf = std::make_unique<MemoryShelf>();
    VoxelSource source({{0, 0, 0}, {110, 70, 40}}, solid);
    for (Brick brick; source.read(brick);) shelf->put(brick.coord, brick.fill, brick.bits);
    return shelf;
  };
  const auto touched = shelf_of(houses);
  const auto hidden = shelf_of([&](VoxelCoord p) { return kRight.grown(-3).contains(p); });
  const std::vector<Footprint> parts = footprints(*touched, *hidden, 1);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].columns == 20 * 30 + 1);
  CHECK(parts[0].hidden == 0);
  CHECK(parts[0].box.min.x == 0);
  CHECK(parts[0].box.max.x == 21);
  CHECK(parts[0].box.max.z == 31);
  CHECK(parts[0].box.max.y == 51);
  CHECK(parts[1].columns == 30 * 10);
  CHECK(parts[1].hidden == 24 * 24 * 4);
  CHECK(footprints(*touched, *hidden, 0).size() == 3);  // along x the corner stands apart
}
