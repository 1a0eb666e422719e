#include <random>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
#include "lib/volume/dilate_ball.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

namespace {

const std::vector<VoxelCoord> kSeeds = {{0, 0, 0}, {63, 5, -64}, {64, 7, -61}, {-1, -1, 40}};

/// The definition: whether the cube at p is within `reach` of a seed's cube.
bool is_near(const VoxelCoord& p, double reach) {
  return std::any_of(kSeeds.begin(), kSeeds.end(), [&](const VoxelCoord& s) {
    double squared = 0;
    for (int i = 0; i < 3; ++i) {
      const double gap = std::max(std::abs(p[i] - s[i]) - 1, 0);
      squared += gap * gap;
    }
    return p == s || squared < reach * reach;
  });
}

/// The seeds' dilation.
std::unique_ptr<BrickShelf> grown(double reach, const MemoryShare& memory = {}) {
  test::MemoryShelf in;
  auto out = std::make_unique<test::MemoryShelf>();
  BitBox bits(voxels_of(BrickBox{{-1, -1, -1}, {2, 1, 1}}));
  for (const VoxelCoord& s : kSeeds) bits.set(s);
  store_voxels(bits, in);
  dilate_ball(in, reach, *out, memory);
  return out;
}

bool test_voxel(const BrickShelf& shelf, const VoxelCoord& p) {
  BitBox one(VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}});
  load_voxels(shelf, one);
  return one.test(p);
}

}  // namespace

TEST_CASE("a ball's dilation holds the voxels with cubes nearer than its reach, across bricks, and no others",
          "[quick][grid]") {
  const double reach = GENERATE(0.0, 0.5, 1.0, 1.01, 1.5, 2.0, 3.7, 9.2, 20.5);
  const ThreadLimit threads(GENERATE(1, 2));
  const auto out = grown(reach);
  std::uint64_t expected = 0, held = 0;
  for_each(VoxelBox{{-1, -1, -64}, {65, 8, 41}}.grown(23), [&](const VoxelCoord& p) { expected += is_near(p, reach); });
  BrickBits one;
  for (const BrickCoord& c : out->coords()) {
    (void)out->get(c, one);
    for_each_voxel(one, c, [&](const VoxelCoord& p) { held += is_near(p, reach) ? 1 : 1 << 30; });
  }
  CHECK(held == expected);
}

TEST_CASE("a ball's dilation by many voxels is exact", "[quick][grid]") {
  const double reach = GENERATE(77.3, 140.0, 200.01);
  const auto out = grown(reach);
  std::mt19937 random(7);
  const std::int32_t side = std::int32_t(reach) + 70;
  std::uint64_t inside = 0;
  for (int i = 0; i < 20000; ++i) {
    VoxelCoord p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::int32_t(random() % std::uint32_t(2 * side)) - side;
    const bool near = is_near(p, reach);
    inside += near;
    if (test_voxel(*out, p) != near) FAIL_CHECK(p.x << ", " << p.y << ", " << p.z);
  }
  CHECK(inside > 1000);
}

TEST_CASE("a ball's dilation is the same in little memory, or refused", "[quick][grid]") {
  const auto voxels = [](const BrickShelf& shelf) {
    std::vector<std::pair<BrickCoord, BrickBits>> all;
    for (const BrickCoord& c : shelf.coords()) {
      all.emplace_back(c, BrickBits());
      (void)shelf.get(c, all.back().second);
    }
    return all;
  };
  CHECK(voxels(*grown(40, {20 << 20})) == voxels(*grown(40)));
  CHECK_THROWS_AS(grown(40, {1 << 20}), NeedsMemory);
}
