#include "lib/volume/cell_boxes.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"

using namespace bp;

namespace {

BitBox of_boxes(const FewBoxes& few, const VoxelBox& box) {
  BitBox bits(box);
  for (const VoxelBox& b : few.boxes) {
    for (VoxelCoord p = b.min * few.unit; p.z < b.max.z * few.unit; ++p.z) {
      for (p.y = b.min.y * few.unit; p.y < b.max.y * few.unit; ++p.y) {
        for (p.x = b.min.x * few.unit; p.x < b.max.x * few.unit; ++p.x) {
          REQUIRE(!bits.test(p));  // no two boxes hold it
          bits.set(p);
        }
      }
    }
  }
  return bits;
}

}  // namespace

TEST_CASE("boxes hold all voxels of a set and no others, each once", "[quick][grid]") {
  reference::Random random(GENERATE(range(1u, 8u)));
  const BitBox voxels = reference::random_solid(random, {{-70, -3, -9}, {61, 20, 14}});
  const FewBoxes few = few_boxes_of(voxels, 1 << 20);
  CHECK(few.unit == 1);
  CHECK(of_boxes(few, voxels.box()) == voxels);
}

TEST_CASE("fewer boxes are those of larger cells, and hold all voxels still", "[quick][grid]") {
  reference::Random random(GENERATE(range(1u, 8u)));
  const VoxelBox box{{-70, -3, -9}, {61, 20, 14}};
  const BitBox voxels = reference::random_solid(random, box);
  const FewBoxes few = few_boxes_of(voxels, 9);
  CHECK(few.boxes.size() <= 9);
  const BitBox held = of_boxes(few, box.grown(300));
  bool all = true;
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) all = all && (!voxels.test(p) || held.test(p));
    }
  }
  CHECK(all);
}
