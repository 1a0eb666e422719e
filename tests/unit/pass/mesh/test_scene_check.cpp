#include <algorithm>

#include "lib/pass/mesh/scene_check.h"
#include "lib/voxel/voxelize.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"

using namespace bp;
using bp::test::MemoryShelf;

namespace {

/// Two triangles across several bricks, one near the border of a brick.
std::vector<TriangleD> scene() {
  return {{Vec3d{10, 10, 10}, Vec3d{150, 40, 20}, Vec3d{30, 140, 90}},
          {Vec3d{63.5, 20, 63.5}, Vec3d{64.5, 21, 65.5}, Vec3d{62, 25, 66}}};
}

void voxelize(const std::vector<TriangleD>& triangles, const GridFrame& frame, MemoryShelf& shelf) {
  BitBox bits({{0, 0, 0}, {192, 192, 192}});
  std::vector<FixedTriangle> fixed;
  for (const TriangleD& t : triangles) fixed.push_back(to_fixed(frame, t));
  voxelize_surface(fixed, bits);
  store_voxels(bits, shelf);
}

}  // namespace

TEST_CASE("a scene lies within its own voxels, and no part of it elsewhere does", "[quick][pass]") {
  const GridFrame frame;
  MemoryShelf shelf;
  voxelize(scene(), frame, shelf);
  CHECK(lies_within(scene(), {}, frame, shelf));
  CHECK(lies_within({}, {}, frame, shelf));
  std::vector<TriangleD> moved = scene();
  for (Vec3d& p : moved[1]) p[0] += 3;
  CHECK_FALSE(lies_within(moved, {}, frame, shelf));
  moved = scene();
  moved[0][1] = {500, 40, 20};  // beyond the bricks
  CHECK_FALSE(lies_within(moved, {}, frame, shelf));
  moved = scene();
  moved[0][1][2] = 0;  // on their outer border: the voxel beyond is not there
  CHECK_FALSE(lies_within(moved, {}, frame, shelf));
}

TEST_CASE("one voxel missing is found", "[quick][pass]") {
  const GridFrame frame;
  MemoryShelf shelf;
  voxelize(scene(), frame, shelf);
  BrickBits bits{};
  REQUIRE(shelf.get({1, 0, 0}, bits) != BrickFill::empty);
  const auto word = std::find_if(bits.begin(), bits.end(), [](std::uint64_t w) { return w != 0; });
  *word &= *word - 1;
  shelf.put({1, 0, 0}, classify(bits), bits);
  CHECK_FALSE(lies_within(scene(), {}, frame, shelf));
}

TEST_CASE("a rounded scene needs the voxels that it may lie in, too", "[quick][pass][rounding]") {
  const GridFrame frame;
  MemoryShelf shelf;
  voxelize(scene(), frame, shelf);
  Rounding rounding;
  rounding.see(0x1p-20, 150, 0);
  CHECK(lies_within(scene(), rounding, frame, shelf));
  rounding.see(0.1, 150, 0);
  CHECK_FALSE(lies_within(scene(), rounding, frame, shelf));
  rounding.see(10, 150, 0);  // more than any voxels tell
  CHECK_FALSE(lies_within(scene(), rounding, frame, shelf));
}
