#include <random>

#include "lib/voxel/voxelize.h"
#include "tests/backend/available_backends.h"
#include "tests/catch.h"

using namespace bp;

namespace {

using Rng = std::mt19937_64;

std::int64_t pick(Rng& rng, std::int64_t low, std::int64_t high) {
  return low + std::int64_t(rng() % std::uint64_t(high - low + 1));
}

/// A triangle around `box` that reaches about `extent` units; now and then flat, aligned, on voxel borders or
/// degenerate.
FixedTriangle random_triangle(Rng& rng, const VoxelBox& box, std::int64_t extent) {
  std::int64_t p[3][3];
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t centre = pick(rng, (box.min[axis] - 1) * kFixedOne, (box.max[axis] + 1) * kFixedOne);
    for (auto& q : p) q[axis] = centre + pick(rng, -extent / 2, extent / 2);
  }
  const int axis = int(pick(rng, 0, 2)), kind = int(pick(rng, 0, 7));
  if (kind == 0) p[1][axis] = p[2][axis] = p[0][axis];
  if (kind == 1) {
    for (auto& q : p) {
      for (auto& c : q) c = floor_div(c, kFixedOne) * kFixedOne + pick(rng, -2, 2);
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (kind == 2) p[1][i] = p[0][i];
    if (kind == 3) p[2][i] = 2 * p[1][i] - p[0][i];
    if (kind == 4) p[2][i] = p[1][i] + pick(rng, -3, 3);
  }
  const auto point = [](const std::int64_t* q) { return FixedPoint{q[0], q[1], q[2]}; };
  return {point(p[0]), point(p[1]), point(p[2])};
}

}  // namespace

TEST_CASE("voxelizing triangles of any size sets the same voxels on each backend", "[quick][backend]") {
  // from a tenth of a voxel to far beyond the box: every route, and mixtures of them
  const std::int64_t extent = GENERATE(as<std::int64_t>{}, 7000, 70000, 300000, 1048576, 1400000, 12000000, 300000000,
                                       3000000000, std::int64_t(1) << 36);
  const auto backends = available_backends();
  Rng rng(std::uint64_t(extent) * 11 + 3);
  for (int round = 0; round < 6; ++round) {
    const VoxelBox box{
        {-64 * std::int32_t(pick(rng, 0, 3)), -7, 5},
        {64 * std::int32_t(pick(rng, 1, 3)), std::int32_t(pick(rng, 0, 60)), std::int32_t(pick(rng, 6, 300))}};
    std::vector<FixedTriangle> triangles;
    const std::int64_t n = pick(rng, 1, 90);
    for (std::int64_t i = 0; i < n; ++i) triangles.push_back(random_triangle(rng, box, i % 9 == 8 ? 90000 : extent));
    BitBox want(box);
    want.set({box.max.x - 1, box.min.y, box.min.z});  // what is set stays set
    BitBox start = want;
    voxelize_surface(triangles, want);
    for (const auto& backend : backends) {
      CAPTURE(backend->name(), extent, round, n);
      BitBox got = start;
      backend->voxelize(triangles, got);
      CHECK(got == want);
    }
  }
}
