#include <cmath>

#include "lib/core/error.h"
#include "lib/core/grid_frame.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("every lattice point of a frame is an exact double", "[quick][core]") {
  const double offset = GENERATE(0.0, 455564.0, 6.80176e6, -3e7);
  const double voxel = GENERATE(0.1, 0.001, 1.0, 31.7);
  Bounds3d bounds;
  bounds.add({offset, offset * 0.5, -offset});
  bounds.add({offset + 300 * voxel, offset * 0.5 + 20 * voxel, -offset + 7 * voxel});
  const GridFrame frame = make_frame(bounds, voxel);
  CHECK(frame.voxel >= voxel);
  CHECK(frame.voxel <= voxel * (1 + 1.0 / 128));
  for (std::int64_t i = -64 * 5000; i < 64 * 5000; i += 977) {
    const Vec3d p = frame.world({i, -i, i + 1});
    // Going back must give the same integer, with nothing left over.
    CHECK(p[0] / (frame.voxel / 64) == double(64 * frame.origin[0] + i));
    CHECK(std::fma(double(64 * frame.origin[2] + i + 1), frame.voxel / 64, -p[2]) == 0);
  }
}

TEST_CASE("a frame refuses what it cannot hold", "[quick][core]") {
  Bounds3d bounds;
  CHECK_THROWS_AS(make_frame(bounds, 1), Error);
  bounds.add({0, 0, 0});
  bounds.add({1, 1, 1});
  CHECK_THROWS_AS(make_frame(bounds, 0), Error);
  CHECK_THROWS_AS(make_frame(bounds, -1), Error);
  CHECK_THROWS_AS(make_frame(bounds, NAN), Error);
  CHECK_THROWS_AS(make_frame(bounds, 1e-10), Error);
}

TEST_CASE("voxel bounds hold the scene with a margin", "[quick][core]") {
  Bounds3d bounds;
  bounds.add({-1, 2, 3});
  bounds.add({9, 4, 3});
  const GridFrame frame = make_frame(bounds, 0.5);
  const VoxelBox box = voxel_bounds(frame, bounds);
  CHECK(box.min == VoxelCoord{-1, -1, -1});
  CHECK(box.max.x == 22);
  CHECK(box.max.z == 2);
}
