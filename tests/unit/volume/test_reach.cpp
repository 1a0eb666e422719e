#include <deque>
#include <random>

#include "lib/volume/dilate.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

namespace bp::test {

namespace {

/// By the definition: voxel after voxel.
BitBox reference(const BitBox& solid, const BitBox& seeds) {
  BitBox out = seeds;
  std::deque<VoxelCoord> open;
  const VoxelBox& box = solid.box();
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z)
    for (p.y = box.min.y; p.y < box.max.y; ++p.y)
      for (p.x = box.min.x; p.x < box.max.x; ++p.x)
        if (seeds.test(p)) open.push_back(p);
  while (!open.empty()) {
    const VoxelCoord p = open.front();
    open.pop_front();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        VoxelCoord q = p;
        q[axis] += step;
        if (!solid.test(q) || out.test(q)) continue;
        out.set(q);
        open.push_back(q);
      }
    }
  }
  return out;
}

}  // namespace

TEST_CASE("seeds grow over the parts that hold them, and no others", "[quick][grid]") {
  std::mt19937 random(unsigned(GENERATE(range(0, 12))));
  const VoxelBox box{{-64, -5, 3}, {128, 30, 40}};
  const unsigned percent = 25 + random() % 30;  // around where parts begin to be large and winding
  BitBox solid(box), seeds(box);
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z)
    for (p.y = box.min.y; p.y < box.max.y; ++p.y)
      for (p.x = box.min.x; p.x < box.max.x; ++p.x)
        if (random() % 100 < percent) {
          solid.set(p);
          if (random() % 5000 == 0) seeds.set(p);
        }
  const BitBox expected = reference(solid, seeds);
  grow_within(solid, seeds);
  CHECK(seeds == expected);
}

}  // namespace bp::test
