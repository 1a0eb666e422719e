#include <map>
#include <random>
#include <tuple>

#include "lib/core/parallel.h"
#include "lib/volume/boundary_rects.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A face: its axis, and the lowest corner.
using Face = std::tuple<int, std::int32_t, std::int32_t, std::int32_t>;

std::map<Face, int> faces_of(const std::vector<FaceRect>& rects) {
  std::map<Face, int> count;
  for (const FaceRect& r : rects) {
    const int axis = r.min.x == r.max.x ? 0 : r.min.y == r.max.y ? 1 : 2;
    VoxelCoord end = r.max;
    end[axis] += 1;
    for (VoxelCoord p = r.min; p.z < end.z; ++p.z) {
      for (p.y = r.min.y; p.y < end.y; ++p.y) {
        for (p.x = r.min.x; p.x < end.x; ++p.x) ++count[{axis, p.x, p.y, p.z}];
      }
    }
  }
  return count;
}

std::map<Face, int> faces_of(const VoxelBox& box, const Solid& solid) {
  std::map<Face, int> count;
  const auto occupied = [&](const VoxelCoord& p) { return box.contains(p) && solid(p); };
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) {
        if (!occupied(p)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          VoxelCoord before = p, after = p;
          before[axis] -= 1;
          after[axis] += 1;
          if (!occupied(before)) ++count[{axis, p.x, p.y, p.z}];
          if (!occupied(after)) ++count[{axis, after.x, after.y, after.z}];
        }
      }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("rectangles hold each face of the voxels once, and few hold many", "[quick][grid]") {
  const VoxelBox box{{-70, -3, -66}, {75, 68, 70}};  // 4 x 3 x 4 bricks, around the origin
  std::mt19937 random(7);
  const Solid solids[] = {
      [](VoxelCoord p) { return p.x * p.x + p.y * p.y + p.z * p.z < 3600; },
      [](VoxelCoord) { return true; },  // whole rows of 64
      [](VoxelCoord p) { return (p.x + p.y + p.z) % 2 == 0; },
      [&](VoxelCoord) { return random() % 9 == 0; },
      [](VoxelCoord p) { return p.x == 0 || p.y == 64 || p.z == -1; },
  };
  const int i = GENERATE(range(0, 5));
  CAPTURE(i);
  const BitBox bits = bp::test::bits_of(box, solids[i]);
  const Solid solid = [&](VoxelCoord p) { return bits.test(p); };
  MemoryShelf shelf;
  fill_shelf(shelf, box, solid);
  const std::vector<FaceRect> rects = boundary_rects(shelf);
  CHECK(faces_of(rects) == faces_of(box, solid));
  if (i == 1) CHECK(rects.size() == 2 * (4 * 3 + 4 * 4 + 3 * 4));  // one for each brick's side
  const ThreadLimit one(1);
  CHECK(boundary_rects(shelf) == rects);
}
