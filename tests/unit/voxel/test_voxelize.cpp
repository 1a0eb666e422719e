#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "lib/voxel/overlap.h"
#include "lib/voxel/voxelize.h"
#include "tests/catch.h"
#include "tests/reference/voxelize.h"

using namespace bp;

namespace {

using Rng = std::mt19937_64;

std::int64_t pick(Rng& rng, std::int64_t low, std::int64_t high) {
  return std::uniform_int_distribution<std::int64_t>(low, high)(rng);
}

/// Moves a coordinate onto a voxel border, or a unit or two beside it.
std::int64_t snap(Rng& rng, std::int64_t x) {
  return floor_div(x, kFixedOne) * kFixedOne + pick(rng, -2, 2);
}

/// A triangle whose centroid lies in `box`, reaching about `extent` units.
FixedTriangle random_triangle(Rng& rng, const VoxelBox& box, std::int64_t extent) {
  std::array<std::array<std::int64_t, 3>, 3> p{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t centre = pick(rng, (box.min[axis] - 1) * kFixedOne, (box.max[axis] + 1) * kFixedOne);
    const std::size_t i = std::size_t(axis);
    p[0][i] = centre + pick(rng, -extent / 2, extent / 2);
    p[1][i] = centre + pick(rng, -extent / 2, extent / 2);
    p[2][i] = 3 * centre - p[0][i] - p[1][i];
  }
  const std::size_t axis = std::size_t(pick(rng, 0, 2));
  switch (pick(rng, 0, 9)) {
    case 0:  // axis-aligned
      p[1][axis] = p[2][axis] = p[0][axis];
      break;
    case 1:  // axis-aligned on a voxel border, or just beside it
      p[0][axis] = p[1][axis] = p[2][axis] = snap(rng, p[0][axis]);
      break;
    case 2:  // corners on voxel corners
      for (auto& q : p)
        for (auto& c : q) c = snap(rng, c);
      break;
    case 3:  // a segment
      p[1] = p[0];
      break;
    case 4:  // collinear, three different points
      for (std::size_t i = 0; i < 3; ++i) p[2][i] = 2 * p[1][i] - p[0][i];
      break;
    case 5:  // a point
      p[1] = p[2] = p[0];
      break;
    case 6:  // a sliver
      for (std::size_t i = 0; i < 3; ++i) p[2][i] = p[1][i] + pick(rng, -3, 3);
      break;
    default:
      break;
  }
  const auto point = [](const auto& q) { return FixedPoint{q[0], q[1], q[2]}; };
  return {point(p[0]), point(p[1]), point(p[2])};
}

}  // namespace

TEST_CASE("surface voxels equal the thirteen separating axes, cube by cube", "[quick][voxel]") {
  // Around one voxel, up to and beyond the limits of the 64-bit paths (16 voxels, 16384 voxels), and giant.
  const std::int64_t extent = GENERATE(as<std::int64_t>{}, 900, 70000, 200000, 600000, 1048576, 1400000, 6000000,
                                       300000000, 1100000000, 3000000000, std::int64_t(1) << 36, std::int64_t(1) << 39);
  Rng rng(std::uint64_t(extent) * 7 + 1);
  const VoxelBox box{{-64, -3, 5}, {64, 6, 13}};
  for (int i = 0; i < 60; ++i) {
    const FixedTriangle t = random_triangle(rng, box, extent);
    const std::int64_t slack = std::array{kFixedSlack, std::int64_t(777), kMostFixedSlack}[std::size_t(i % 3)];
    BitBox out(box);
    voxelize_surface({&t, 1}, out, slack);
    CAPTURE(i, extent, slack, t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z);
    REQUIRE(out == reference::voxelize({&t, 1}, BitBox(box), slack));
  }
}

TEST_CASE("the per-voxel test of small and medium triangles agrees with the rows", "[quick][voxel]") {
  const std::int64_t extent = GENERATE(as<std::int64_t>{}, 100000, 900000, 5000000);
  Rng rng(std::uint64_t(extent) + 5);
  const VoxelBox box{{0, 0, 0}, {64, 12, 12}};
  for (int i = 0; i < 60; ++i) {
    const FixedTriangle t = random_triangle(rng, box, extent);
    const Corners corners(t);
    const CellRange range = voxel_range(corners);
    BitBox out(box), tested(box);
    voxelize_surface({&t, 1}, out);
    const MediumTriangle medium(corners, range, kFixedOne);
    const WideTriangle wide(corners, range, kFixedOne);
    for (std::int32_t z = 0; z < 12; ++z)
      for (std::int32_t y = 0; y < 12; ++y)
        for (std::int32_t x = 0; x < 64; ++x) {
          const std::int64_t c[3] = {x - range.min[0], y - range.min[1], z - range.min[2]};
          bool inside = true;
          for (int axis = 0; axis < 3; ++axis) inside = inside && c[axis] >= 0 && c[axis] < range.size(axis);
          if (!inside) continue;
          const bool meets = medium.meets(std::int32_t(c[0]), std::int32_t(c[1]), std::int32_t(c[2]));
          REQUIRE(meets == wide.meets(std::int32_t(c[0]), std::int32_t(c[1]), std::int32_t(c[2])));
          if (meets) tested.set({x, y, z});
        }
    REQUIRE(tested == out);
  }
}

TEST_CASE("voxelizing keeps what is set and ignores what lies outside", "[quick][voxel]") {
  BitBox out(VoxelBox{{0, 0, 0}, {64, 4, 4}});
  out.set({5, 1, 1});
  const std::int64_t far = std::int64_t(1) << 46;
  const FixedTriangle t[] = {{{far, far, far}, {far + 9, far, far}, {far, far + 9, far}},
                             {{-far, -far, -far}, {-far, -far, -far}, {-far, -far, -far}},
                             {{0, 0, -far}, {65536, 0, -far}, {0, 65536, -65539}}};
  voxelize_surface(t, out);
  CHECK(out.count() == 1);
  CHECK(out.test({5, 1, 1}));
}

TEST_CASE("a triangle as large as the largest grid is voxelized exactly", "[quick][voxel]") {
  const VoxelBox box{{-64, -9, -8}, {64, 7, 9}};
  const std::int64_t b = std::int64_t(1) << 45;
  BitBox slanted(box), upright(box), expected_slanted(box), expected_upright(box);
  const FixedTriangle plane{{-b, -b, -2 * b}, {b, 0, b}, {0, b, b}};  // z = x + y, centroid at the origin
  const FixedTriangle wall{{3 * kFixedOne, -b, -b}, {3 * kFixedOne, b, -b}, {3 * kFixedOne, 0, 2 * b}};  // x = 3
  voxelize_surface({&plane, 1}, slanted);
  voxelize_surface({&wall, 1}, upright);
  for (std::int32_t z = box.min.z; z < box.max.z; ++z)
    for (std::int32_t y = box.min.y; y < box.max.y; ++y)
      for (std::int32_t x = box.min.x; x < box.max.x; ++x) {
        if (x + y - z >= -2 && x + y - z <= 1) expected_slanted.set({x, y, z});
        if (x == 2 || x == 3) expected_upright.set({x, y, z});
      }
  CHECK(slanted == expected_slanted);
  CHECK(upright == expected_upright);
}

TEST_CASE("tiles of a triangle are those it meets", "[quick][voxel]") {
  const std::int64_t extent =
      GENERATE(as<std::int64_t>{}, 100000, 3000000, 100000000, std::int64_t(1) << 32, std::int64_t(1) << 39);
  Rng rng(std::uint64_t(extent) + 3);
  const VoxelCoord first{-64, -10, 7};
  const TileCoord count{3, 4, 5};
  const std::int32_t edge = 64;
  const VoxelBox box{first, {first.x + 192, first.y + 256, first.z + 320}};
  for (int i = 0; i < 60; ++i) {
    const FixedTriangle t = random_triangle(rng, box, extent);
    std::set<std::tuple<int, int, int>> got, expected;
    for_each_tile(t, first, edge, count, [&](TileCoord c) { CHECK(got.insert({c.x, c.y, c.z}).second); });
    for (int z = 0; z < count.z; ++z)
      for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x) {
          const FixedPoint corner{(first.x + x * edge) * kFixedOne, (first.y + y * edge) * kFixedOne,
                                  (first.z + z * edge) * kFixedOne};
          if (reference::meets(t, corner, edge * kFixedOne)) expected.insert({x, y, z});
        }
    CAPTURE(i, extent);
    REQUIRE(got == expected);
  }
}

TEST_CASE("fixed point is within one unit of the scene, near the origin and far from it", "[quick][voxel]") {
  const double offset = GENERATE(0.0, 455564.0, 6.80176e6, -3e7);
  const double voxel = GENERATE(0.1, 0.013, 3.7);
  Bounds3d bounds;
  bounds.add({offset, -offset, offset / 3});
  bounds.add({offset + 5000 * voxel, -offset + 70 * voxel, offset / 3 + 9 * voxel});
  const GridFrame frame = make_frame(bounds, voxel);
  Rng rng(11);
  for (int i = 0; i < 2000; ++i) {
    Vec3d p;
    for (std::size_t a = 0; a < 3; ++a)
      p[a] = std::uniform_real_distribution<double>(bounds.min[a], bounds.max[a])(rng);
    const FixedPoint f = to_fixed(frame, p);
    const std::int64_t c[3] = {f.x, f.y, f.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const long double exact = static_cast<long double>(p[a]) / frame.voxel - frame.origin[a];  // 11 bits to spare
      const long double error = exact * kFixedOne - c[a];
      REQUIRE(error < 0.5L + 1.0L / 16);
      REQUIRE(error > -0.5L - 1.0L / 16);
    }
  }
}
