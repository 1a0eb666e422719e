#include "lib/volume/mirror.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kBox{{-70, -3, 0}, {90, 70, 5}};

bool some(VoxelCoord p) {
  return kBox.contains(p) && (p.x * 7 + p.y * 13 + p.z * 29) % 11 == 0;
}

std::unique_ptr<BrickShelf> make() {
  return std::make_unique<MemoryShelf>();
}

}  // namespace

TEST_CASE("a mirror image holds the voxels on the other side of the plane, across bricks", "[quick][grid]") {
  const MirrorPlane plane{GENERATE(0, 1, 2), GENERATE(-5, 0, 1, 32, 64, 77)};
  MemoryShelf in, out;
  fill_shelf(in, kBox, some);
  add_mirrored(in, plane, out);
  VoxelBox around = kBox;
  for (const VoxelCoord& p : {plane.mirrored(kBox.min), plane.mirrored(kBox.max)})
    around = hull(around, VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}});
  BitBox image(around);
  load_voxels(out, image);
  bool same = true;
  for (VoxelCoord p = around.min; p.z < around.max.z; ++p.z) {
    for (p.y = around.min.y; p.y < around.max.y; ++p.y) {
      for (p.x = around.min.x; p.x < around.max.x; ++p.x) same = same && image.test(p) == some(plane.mirrored(p));
    }
  }
  CHECK(same);
}

TEST_CASE("voxels are symmetric if their image is near them", "[quick][grid]") {
  const int off = GENERATE(0, 1, 2, 3);
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {100, 20, 20}}, [&](VoxelCoord p) { return p.y > 5 || p.x < 20 || p.x >= 80 + off; });
  CHECK(is_symmetric(shelf, {0, 50}, 2, make) == (off < 3));
  CHECK_FALSE(is_symmetric(shelf, {1, 10}, 2, make));
  CHECK(is_symmetric(shelf, {2, 10}, 1, make));
}
