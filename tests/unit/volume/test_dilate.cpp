#include <random>

#include "lib/volume/dilate.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("dilation reaches so far along each axis, across words, and no farther", "[quick][grid]") {
  const VoxelBox box{{-64, -5, 2}, {128, 9, 13}};
  const std::int32_t reach = GENERATE(0, 1, 2, 3, 4, 5, 13, 63, 64, 70, 200);
  std::mt19937 random(5);
  std::vector<VoxelCoord> seeds;
  for (int i = 0; i < 6; ++i) {
    seeds.push_back({box.min.x + std::int32_t(random() % 192), box.min.y + std::int32_t(random() % 14),
                     box.min.z + std::int32_t(random() % 11)});
  }
  BitBox voxels(box);
  for (const VoxelCoord& s : seeds) voxels.set(s);
  dilate(voxels, reach);
  bool same = true;
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) {
        bool near = false;
        for (const VoxelCoord& s : seeds) {
          near = near || (std::abs(p.x - s.x) <= reach && std::abs(p.y - s.y) <= reach && std::abs(p.z - s.z) <= reach);
        }
        same = same && voxels.test(p) == near;
      }
    }
  }
  CHECK(same);
}
