#include <algorithm>
#include <random>
#include <vector>

#include "lib/core/error.h"
#include "lib/volume/outside.h"
#include "tests/catch.h"
#include "tests/reference/flood.h"

using namespace bp;

namespace {

std::vector<VoxelBox> cut(const VoxelBox& grid, VoxelCoord tile) {
  std::vector<VoxelBox> tiles;
  for (std::int32_t z = grid.min.z; z < grid.max.z; z += tile.z)
    for (std::int32_t y = grid.min.y; y < grid.max.y; y += tile.y)
      for (std::int32_t x = grid.min.x; x < grid.max.x; x += tile.x)
        tiles.push_back(intersect(grid, VoxelBox{{x, y, z}, VoxelCoord{x, y, z} + tile}));
  return tiles;
}

bool any_voxel(const BitBox& solid, const VoxelBox& tile) {
  BitBox part(tile);
  copy_voxels(solid, part);
  for (std::int32_t z = tile.min.z; z < tile.max.z; ++z)
    for (std::int32_t y = tile.min.y; y < tile.max.y; ++y)
      for (std::int32_t x = tile.min.x; x < tile.max.x; ++x)
        if (part.test({x, y, z})) return true;
  return false;
}

/// Random voxels: noise near the percolation threshold, or a few random shells.
BitBox random_solid(std::mt19937& rng, const VoxelBox& grid) {
  BitBox solid(grid);
  const auto pick = [&](std::int32_t lo, std::int32_t hi) {
    return std::uniform_int_distribution<std::int32_t>(lo, hi)(rng);
  };
  const auto set = [&](VoxelCoord p) {
    if (grid.contains(p)) solid.set(p);
  };
  const int percent = pick(0, 2) == 0 ? 0 : pick(30, 80);
  for (std::int64_t n = grid.volume() * percent / 100; n > 0; --n)
    set({pick(grid.min.x, grid.max.x - 1), pick(grid.min.y, grid.max.y - 1), pick(grid.min.z, grid.max.z - 1)});
  for (int shells = pick(percent == 0 ? 1 : 0, 4); shells > 0; --shells) {
    VoxelBox b;
    for (int i = 0; i < 3; ++i) {
      b.min[i] = pick(grid.min[i] - 2, grid.max[i] - 1);
      b.max[i] = pick(b.min[i], grid.max[i] + 2);
    }
    for (std::int32_t z = b.min.z; z <= b.max.z; ++z)
      for (std::int32_t y = b.min.y; y <= b.max.y; ++y)
        for (std::int32_t x = b.min.x; x <= b.max.x; ++x) {
          const bool face =
              x == b.min.x || x == b.max.x || y == b.min.y || y == b.max.y || z == b.min.z || z == b.max.z;
          if (face && pick(0, 999) != 0) set({x, y, z});
        }
  }
  return solid;
}

BitBox flood_by_tiles(std::mt19937& rng, BitBox solid, const VoxelBox& grid, VoxelCoord tile_vox) {
  OutsideFlood flood(grid, tile_vox);
  std::vector<VoxelBox> tiles = cut(grid, tile_vox);
  std::shuffle(tiles.begin(), tiles.end(), rng);
  for (const VoxelBox& tile : tiles) {
    if (any_voxel(solid, tile)) {
      flood.join(OutsideFlood::label(solid, tile));
    } else if (rng() % 2 == 0) {
      flood.join(OutsideFlood::label_empty(tile));
    }  // else never joined: counts as empty
  }
  flood.resolve();
  for (const VoxelBox& tile : tiles) {
    BitBox part(tile);
    copy_voxels(solid, part);
    const std::uint64_t before = part.count();
    const std::uint64_t filled = flood.fill_enclosed(tile, solid);
    BitBox after(tile);
    copy_voxels(solid, after);
    CHECK(after.count() - before == filled);
    CHECK(flood.has_enclosed(tile) == (filled > 0));
  }
  return solid;
}

}  // namespace

TEST_CASE("the flood over tiles equals one flood over the whole grid", "[quick][grid]") {
  const unsigned seed = GENERATE(range(0u, 60u));
  std::mt19937 rng(seed);
  const auto pick = [&](std::int32_t lo, std::int32_t hi) {
    return std::uniform_int_distribution<std::int32_t>(lo, hi)(rng);
  };
  VoxelBox grid;
  for (int i = 0; i < 3; ++i) {
    grid.min[i] = i == 0 ? pick(-2, 1) * 64 : pick(-30, 30);
    grid.max[i] = grid.min[i] + (i == 0 ? pick(1, 150) : pick(1, 40));
  }
  const BitBox solid = random_solid(rng, grid);
  // 64 and above in x as the stages use them; small y and z for many tiles. Words may be counted twice only if tiles
  // share them, so the counts are checked for whole words of x.
  const VoxelCoord tile{64 * pick(1, 2), pick(1, 20), pick(1, 20)};
  CAPTURE(seed, grid.min.x, grid.max.x, tile.x, tile.y, tile.z);
  CHECK(flood_by_tiles(rng, solid, grid, tile) == reference::fill_enclosed(solid, grid));
}

TEST_CASE("tiles that do not begin at whole words flood just the same", "[quick][grid]") {
  const unsigned seed = GENERATE(range(0u, 30u));
  std::mt19937 rng(seed);
  const auto pick = [&](std::int32_t lo, std::int32_t hi) {
    return std::uniform_int_distribution<std::int32_t>(lo, hi)(rng);
  };
  const VoxelBox grid{{pick(-70, 70), -3, 5}, {pick(80, 160), 12, 25}};
  BitBox solid = random_solid(rng, grid);
  const VoxelCoord tile{pick(5, 70), pick(3, 9), pick(3, 9)};
  CAPTURE(seed, grid.min.x, grid.max.x, tile.x, tile.y, tile.z);
  const BitBox expected = reference::fill_enclosed(solid, grid);
  OutsideFlood flood(grid, tile);
  for (const VoxelBox& t : cut(grid, tile)) flood.join(OutsideFlood::label(solid, t));
  flood.resolve();
  for (const VoxelBox& t : cut(grid, tile)) flood.fill_enclosed(t, solid);
  CHECK(solid == expected);
}

TEST_CASE("an empty grid has nothing enclosed, joined or not", "[quick][grid]") {
  const VoxelBox grid{{0, 0, 0}, {192, 128, 128}};
  OutsideFlood flood(grid, {64, 64, 64});
  flood.join(OutsideFlood::label_empty({{64, 0, 0}, {128, 64, 64}}));
  flood.resolve();
  for (const VoxelBox& tile : cut(grid, {64, 64, 64})) CHECK_FALSE(flood.has_enclosed(tile));
}

TEST_CASE("an empty tile inside a shell of other tiles is enclosed", "[quick][grid]") {
  const VoxelBox grid{{0, 0, 0}, {320, 320, 320}};
  BitBox solid(grid);
  for (std::int32_t z = 10; z < 310; ++z)
    for (std::int32_t y = 10; y < 310; ++y)
      for (std::int32_t x = 10; x < 310; ++x)
        if (x == 10 || x == 309 || y == 10 || y == 309 || z == 10 || z == 309) solid.set({x, y, z});
  OutsideFlood flood(grid, {64, 64, 64});
  for (const VoxelBox& tile : cut(grid, {64, 64, 64}))
    if (any_voxel(solid, tile)) flood.join(OutsideFlood::label(solid, tile));
  flood.resolve();
  const VoxelBox middle{{128, 128, 128}, {192, 192, 192}};
  CHECK(flood.has_enclosed(middle));
  BitBox bits(middle);
  CHECK(flood.fill_enclosed(middle, bits) == 64 * 64 * 64);
  CHECK(bits.count() == 64 * 64 * 64);
}

TEST_CASE("a tile face of 2^32 voxels is refused", "[quick][grid]") {
  CHECK_THROWS_AS(OutsideFlood::label_empty({{0, 0, 0}, {65536, 65536, 1}}), Error);
  CHECK_THROWS_AS(OutsideFlood({{0, 0, 0}, {64, 64, 64}}, {0, 64, 64}), Error);
}
