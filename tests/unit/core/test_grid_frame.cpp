#include <cmath>
#include <random>

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

namespace {

bool is_float(double x) {
  return double(float(x)) == x;
}

Bounds3d cube_at(const Vec3d& place, double side) {
  Bounds3d bounds;
  bounds.add(place);
  bounds.add({place[0] + side, place[1] + side, place[2] + side});
  return bounds;
}

}  // namespace

TEST_CASE("lattice points within 1,024 voxels of the scene's origin are floats", "[quick][core]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 1000; ++n) {
    const double voxel = std::exp(40 * unit(random) - 20), side = (1 + 600 * unit(random)) * voxel;
    const double most = 1000 * voxel - side - side / 64;  // 64ths of the side, and 4 voxels, are left around the scene
    const Bounds3d bounds =
        cube_at({(2 * unit(random) - 1) * most, most * unit(random), -most * unit(random)}, std::min(side, most));
    const GridFrame frame = make_frame(bounds, voxel);
    REQUIRE(frame.voxel >= voxel);
    REQUIRE(frame.voxel <= voxel * (1 + 1.0 / 128));
    const VoxelBox box = voxel_bounds(frame, bounds);
    for (int i = 0; i < 20; ++i) {
      const auto lattice = [&](int axis) {
        const std::int64_t lo = 64 * std::int64_t(box.min[axis]), hi = 64 * std::int64_t(box.max[axis]);
        return lo + std::int64_t(unit(random) * double(hi - lo));
      };
      for (const double c : frame.world({lattice(0), lattice(1), lattice(2)})) REQUIRE(is_float(c));
    }
  }
}

TEST_CASE("lattice points of a scene far away are floats once a point near it is subtracted", "[quick][core]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 1000; ++n) {
    const double voxel = std::exp(10 * unit(random) - 5), side = (1 + 780 * unit(random)) * voxel;
    const double far = voxel * std::exp(7 + 12 * unit(random));
    const Bounds3d bounds = cube_at({far * unit(random), -far, far}, side);
    const GridFrame frame = make_frame(bounds, voxel);
    REQUIRE(frame.voxel >= voxel);
    REQUIRE(frame.voxel <= voxel * (1 + 1.0 / 128));
    const Vec3d origin = frame.world({std::int64_t(32 * side / frame.voxel), 0, 64});
    const VoxelBox box = voxel_bounds(frame, bounds);
    for (int i = 0; i < 3; ++i) {
      for (const std::int64_t c : {64 * std::int64_t(box.min[i]) + 1, 64 * std::int64_t(box.max[i]) - 1}) {
        const auto k = std::size_t(i);
        REQUIRE(is_float(frame.world({c, c, c})[k] - origin[k]));
      }
    }
  }
}

TEST_CASE("a voxel of few bits stays as it is", "[quick][core]") {
  const double voxel = GENERATE(0.25, 0.0703125, 3.0, 255.0);
  const double places = GENERATE(0.0, 700.0, 1e7);  // voxels
  CHECK(make_frame(cube_at({places * voxel, 0, 0}, 300 * voxel), voxel).voxel == voxel);
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
