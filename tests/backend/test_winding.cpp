#include <algorithm>
#include <cstring>

#include "lib/device/cpu/cpu_backend.h"
#include "lib/voxel/overlap.h"
#include "tests/backend/available_backends.h"
#include "tests/backend/random_triangles.h"
#include "tests/catch.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Returns the crossings as sorted keys.
std::vector<std::uint32_t> sorted(const std::vector<Crossing>& crossings) {
  std::vector<std::uint32_t> keys(crossings.size());
  if (!keys.empty()) std::memcpy(keys.data(), crossings.data(), keys.size() * sizeof(Crossing));
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<Crossing> crossings_of(Backend& backend, std::span<const FixedTriangle> triangles, const VoxelBox& tile) {
  std::vector<Crossing> out;
  backend.find_crossings(triangles, tile, out);
  return out;
}

/// No side but x a multiple of what a warp or a bucket takes.
VoxelBox random_tile(Rng& rng) {
  return {{-64 * std::int32_t(pick(rng, 0, 2)), -7, 5},
          {64 * std::int32_t(pick(rng, 1, 3)), std::int32_t(pick(rng, 0, 60)), std::int32_t(pick(rng, 6, 200))}};
}

}  // namespace

TEST_CASE("columns cross triangles of any size at the same voxels on each backend", "[quick][backend]") {
  const std::int64_t extent = GENERATE(as<std::int64_t>{}, 70000, 300000, 1048576, 1400000, 12000000, 3000000000);
  const auto backends = available_backends();
  Rng rng(std::uint64_t(extent) * 7 + 1);
  std::size_t found = 0;
  for (int round = 0; round < 4; ++round) {
    const VoxelBox tile = random_tile(rng);
    std::vector<FixedTriangle> triangles;
    const std::int64_t n = pick(rng, 30, 300) * (extent < kSmallExtent ? 10 : 1);
    for (std::int64_t i = 0; i < n; ++i) triangles.push_back(random_triangle(rng, tile, i % 9 == 8 ? 90000 : extent));
    CpuBackend cpu;
    const std::vector<std::uint32_t> want = sorted(crossings_of(cpu, triangles, tile));
    found += want.size();
    for (const auto& backend : backends) {
      CAPTURE(backend->name(), extent, round, n);
      CHECK(sorted(crossings_of(*backend, triangles, tile)) == want);
    }
  }
  CHECK(found > 0);
}

TEST_CASE("a batch with more crossings than there was room for gives all of them", "[quick][backend]") {
  const VoxelBox tile{{0, 0, 0}, {512, 512, 64}};
  std::vector<FixedTriangle> triangles;
  for (std::int64_t z = 1; z < 6; ++z) {  // each covers the tile
    const FixedPoint a{-kFixedOne, -kFixedOne, z * 700000}, b{1100 * kFixedOne, 0, z * 600000},
        c{0, 1100 * kFixedOne, z * 650000};
    triangles.push_back({a, b, c});
  }
  CpuBackend cpu;
  const std::vector<std::uint32_t> want = sorted(crossings_of(cpu, triangles, tile));
  REQUIRE(want.size() == 5u << 18);
  for (const auto& backend : available_backends()) {
    CAPTURE(backend->name());
    const bool equal = sorted(crossings_of(*backend, triangles, tile)) == want;  // too long to print
    CHECK(equal);
  }
}

TEST_CASE("more triangles than a batch may hold in a wide tile give all crossings", "[quick][backend]") {
  const VoxelBox tile{{0, 0, 0}, {512, 512, 8}};
  Rng rng(5);
  std::vector<FixedTriangle> triangles;
  for (int i = 0; i < 20000; ++i) triangles.push_back(random_triangle(rng, tile, 90000));
  CpuBackend cpu;
  const std::vector<std::uint32_t> want = sorted(crossings_of(cpu, triangles, tile));
  for (const auto& backend : available_backends()) {
    CAPTURE(backend->name());
    const bool equal = sorted(crossings_of(*backend, triangles, tile)) == want;
    CHECK(equal);
  }
}

TEST_CASE("the fill by winding sets the same voxels and leaves the same numbers on each backend", "[quick][backend]") {
  const auto backends = available_backends();
  const int seed = GENERATE(range(0, 10));
  Rng rng(std::uint64_t(seed) + 99);
  const VoxelBox tile = seed == 0 ? VoxelBox{{0, 0, 0}, {64, 2, 32}} : random_tile(rng);
  std::vector<FixedTriangle> triangles;
  const std::int64_t n = seed == 1 ? 0 : pick(rng, 1, 200);
  for (std::int64_t i = 0; i < n; ++i) triangles.push_back(random_triangle(rng, tile, 3000000));
  CpuBackend cpu;
  std::vector<Crossing> crossings = crossings_of(cpu, triangles, tile);
  if (seed % 4 == 2) {  // many crossings of one column, at a few heights
    Crossing c{};
    for (int i = 0; i < 5000; ++i) {
      c.x = 37, c.z = std::uint32_t(pick(rng, 0, tile.size().z)) & 1023, c.down = i % 2 == 0 ? 1 : 0;
      crossings.push_back(c);
    }
  }
  Crossing above_all{};  // counts only in the numbers above the tile
  above_all.z = std::uint32_t(tile.size().z) & 1023, above_all.down = 1;
  crossings.push_back(above_all);
  BitBox start(tile);
  start.set({tile.min.x + 3, tile.min.y, tile.min.z});  // what is set stays set
  std::vector<std::int32_t> below(std::size_t(tile.size().x) * std::size_t(tile.size().y), 0);
  for (std::int32_t& v : below) v = pick(rng, 0, 3) == 0 ? std::int32_t(pick(rng, -2, 2)) : 0;
  std::vector<std::uint64_t> skip;  // columns that the fallback decides
  for (std::size_t i = 0; seed % 3 == 0 && i < below.size() / 64; ++i) skip.push_back(rng() & rng());

  BitBox want = start;
  std::vector<std::int32_t> above = below;
  std::vector<Crossing> again = crossings;
  cpu.fill_winding(again, skip, above, want);
  for (const auto& backend : backends) {
    for (int run = 0; run < 2; ++run) {
      CAPTURE(backend->name(), seed, n, run);
      BitBox got = start;
      std::vector<std::int32_t> numbers = below;
      again = crossings;
      backend->fill_winding(again, skip, numbers, got);
      CHECK(got == want);
      CHECK(numbers == above);
    }
  }
}
