#include <array>

#include "lib/voxel/voxelize.h"
#include "tests/backend/available_backends.h"
#include "tests/backend/random_triangles.h"
#include "tests/catch.h"

using namespace bp;
using namespace bp::test;

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
    const std::int64_t slack = std::array<std::int64_t, 3>{kFixedSlack, 77, kMostFixedSlack}[std::size_t(round % 3)];
    voxelize_surface(triangles, want, slack);
    for (const auto& backend : backends) {
      CAPTURE(backend->name(), extent, round, n);
      BitBox got = start;
      backend->voxelize(triangles, got, slack);
      CHECK(got == want);
    }
  }
}
