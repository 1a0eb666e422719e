#include <algorithm>
#include <random>
#include <vector>

#include "lib/voxel/overlap.h"
#include "lib/voxel/voxelize.h"
#include "lib/voxel/winding.h"
#include "tests/catch.h"
#include "tests/reference/winding.h"
#include "tests/support/memory_scene.h"

using namespace bp;

namespace {

struct Filled {
  BitBox bits;
  std::vector<std::int32_t> above;  ///< numbers above the tile
};

/// Surface and winding of triangles in voxel units over one tile.
Filled fill(const test::Triangles& triangles, const VoxelBox& tile) {
  std::vector<FixedTriangle> fixed;
  for (const TriangleD& t : triangles) {
    const auto point = [](const Vec3d& p) {
      return FixedPoint{std::int64_t(std::lround(p[0] * kFixedOne)), std::int64_t(std::lround(p[1] * kFixedOne)),
                        std::int64_t(std::lround(p[2] * kFixedOne))};
    };
    fixed.push_back({point(t[0]), point(t[1]), point(t[2])});
  }
  Filled f{BitBox(tile), std::vector<std::int32_t>(std::size_t(tile.size().x * tile.size().y), 0)};
  voxelize_surface(fixed, f.bits);
  std::vector<Crossing> crossings;
  find_crossings(fixed, tile, crossings);
  fill_winding(crossings, tile, {}, f.above, f.bits);
  return f;
}

}  // namespace

TEST_CASE("winding fills what solid angles say is inside, and closed meshes cancel", "[quick][voxel]") {
  // Snapped to halves, vertices and edges stand exactly on columns and on voxel borders.
  const double snap = GENERATE(0.0, 0.5, 1.0, 1.0 / 16);
  const VoxelBox tile{{0, 0, 0}, {64, 40, 40}};
  test::Triangles t;
  test::add_sphere(t, {18, 19, 20}, 13, 9, snap);
  test::add_sphere(t, {27.3, 20.1, 18}, 11, 7, snap);  // overlaps the first
  const std::size_t inner = t.size();
  test::add_sphere(t, {17, 18, 19}, 6, 5, snap);  // a cavity: number 0
  test::turn_inside_out(t, inner);
  const std::size_t inverted = t.size();
  test::add_sphere(t, {48, 20, 20}, 10, 6, snap);  // inside out: number -1, solid too
  test::turn_inside_out(t, inverted);
  test::add_box(t, {40, 4, 4}, {44, 36, 9});
  const Filled f = fill(t, tile);
  for (const std::int32_t n : f.above) REQUIRE(n == 0);
  int inside = 0;
  for (std::int32_t z = 0; z < 40; z += 5)
    for (std::int32_t y = 0; y < 40; y += 3)
      for (std::int32_t x = 0; x < 64; ++x) {
        const double n = reference::winding_number(t, {x + 0.5, y + 0.5, z + 0.5});
        if (std::abs(n - std::round(n)) > 1e-3) continue;  // on the surface
        CAPTURE(x, y, z, n);
        if (std::abs(n) > 0.5) {
          ++inside;
          REQUIRE(f.bits.test({x, y, z}));
        }
      }
  CHECK(inside > 400);
}

TEST_CASE("voxels off the surface are solid exactly where the winding number is not zero", "[quick][voxel]") {
  const double snap = GENERATE(0.0, 0.5, 1.0);
  const VoxelBox tile{{0, 0, 0}, {64, 40, 40}};
  test::Triangles t;
  test::add_sphere(t, {20, 20, 20}, 15, 9, snap);
  const std::size_t inner = t.size();
  test::add_sphere(t, {20, 20, 20}, 9, 6, snap);
  test::turn_inside_out(t, inner);  // a hollow
  test::add_sphere(t, {20, 20, 20}, 4, 4, snap);
  const Filled f = fill(t, tile);
  for (std::int32_t z = 0; z < 40; ++z)
    for (std::int32_t y = 0; y < 40; y += 3)
      for (std::int32_t x = 0; x < 40; ++x) {
        const double dx = x + 0.5 - 20, dy = y + 0.5 - 20, dz = z + 0.5 - 20,
                     r = std::sqrt(dx * dx + dy * dy + dz * dz);
        CAPTURE(x, y, z, r);
        if (r < 1.5 || (r > 10.5 && r < 11.5)) REQUIRE(f.bits.test({x, y, z}));
        if ((r > 6 && r < 6.5) || r > 17) REQUIRE_FALSE(f.bits.test({x, y, z}));
      }
}

TEST_CASE("crossings cut by tiles are those of the whole", "[quick][voxel]") {
  const std::int64_t extent = GENERATE(as<std::int64_t>{}, 200000, 900000, 3000000, std::int64_t(3) << 30);
  std::mt19937_64 rng(5);
  std::vector<FixedTriangle> t;
  for (int i = 0; i < 200; ++i) {
    FixedPoint p[3];
    const auto at = [&](std::int64_t c) {
      const std::int64_t v = c * kFixedOne + std::uniform_int_distribution<std::int64_t>(-extent / 2, extent / 2)(rng);
      return i % 3 == 0 ? v : v / (kFixedOne / 2) * (kFixedOne / 2);  // on columns and borders
    };
    for (auto& q : p) q = {at(64), at(64), at(64)};
    t.push_back({p[0], p[1], p[2]});
  }
  const VoxelBox whole{{0, 0, 0}, {128, 128, 128}};
  const auto global = [](const VoxelBox& tile, const std::vector<Crossing>& all) {
    std::vector<std::array<int, 4>> out;
    for (const Crossing& c : all)
      out.push_back({tile.min.x + int(c.x), tile.min.y + int(c.y), tile.min.z + int(c.z), int(c.down)});
    return out;
  };
  std::vector<Crossing> all;
  find_crossings(t, whole, all);
  auto expected = global(whole, all);
  REQUIRE(expected.size() > 20);
  std::vector<std::array<int, 4>> got;
  for (std::int32_t z = 0; z < 128; z += 32)
    for (std::int32_t y = 0; y < 128; y += 64)
      for (std::int32_t x = 0; x < 128; x += 64) {
        const VoxelBox tile{{x, y, z}, {x + 64, y + 64, z + 32}};
        // Only the triangles that meet the tile may be needed.
        std::vector<FixedTriangle> near;
        for (const FixedTriangle& f : t) {
          BitBox bits(tile);
          voxelize_surface({&f, 1}, bits);
          if (bits.count() > 0) near.push_back(f);
        }
        std::vector<Crossing> part;
        find_crossings(near, tile, part);
        for (const auto& c : global(tile, part)) got.push_back(c);
      }
  std::sort(expected.begin(), expected.end());
  std::sort(got.begin(), got.end());
  CHECK(got == expected);
}

TEST_CASE("a column through vertices and edges crosses once", "[quick][voxel]") {
  // A fan around a vertex at the centre of a column, its edges along the column's row and diagonal.
  const double c = 3.5;
  test::Triangles t;
  const Vec3d ring[8] = {{c + 2, c, 2}, {c + 2, c + 2, 2}, {c, c + 2, 2}, {c - 2, c + 2, 2},
                         {c - 2, c, 2}, {c - 2, c - 2, 2}, {c, c - 2, 2}, {c + 2, c - 2, 2}};
  for (int i = 0; i < 8; ++i) t.push_back({Vec3d{c, c, 2}, ring[i], ring[(i + 1) % 8]});
  const Filled f = fill(t, {{0, 0, 0}, {64, 8, 8}});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 64; ++x) {
      // The moved column lies in the ring's square [1.5, 5.5) x [1.5, 5.5).
      const bool in = x >= 1 && x < 5 && y >= 1 && y < 5;
      CAPTURE(x, y);
      CHECK(f.above[std::size_t(x + 64 * y)] == (in ? -1 : 0));
    }
}
