#include <algorithm>

#include "lib/closing/closing_scratch.h"
#include "lib/closing/detail/halves.h"
#include "lib/closing/detail/oriented_dilation.h"
#include "lib/closing/rotation.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"

using namespace bp;
using reference::Random;

namespace {

Halo ample_turned(Scale largest) {
  return {largest / kScaleOne + 2, oriented_reach(largest) + 1};
}

BitBox close_turned(const BitBox& solid, const ScaleLattice& scale, const Halo& halo,
                    const OrientationField& orientation, const VoxelBox& box) {
  static ClosingScratch scratch;  // kept on purpose: what a call leaves behind must not matter to the next
  BitBox closed;
  close_tile(solid, scale, halo, {StructuringElement::cube, &orientation}, box, closed, scratch);
  return closed;
}

void compare_turned(std::uint64_t seed, std::int32_t longest, std::int32_t largest_vox) {
  Random random(seed);
  const VoxelBox grid = reference::random_box(random, longest);
  const BitBox solid = reference::random_solid(random, grid);
  const auto largest = Scale(random.between(0, largest_vox * kScaleOne));
  const VoxelBox box = grid.grown(random.between(0, 3)), seen = box.grown(largest / kScaleOne + 3);
  const ScaleLattice scale = reference::random_lattice(random, seen, largest);
  const OrientationField orientation = reference::random_orientation(random, seen);
  REQUIRE(orientation_fault(orientation) == nullptr);
  CAPTURE(seed, largest, scale.constant(), orientation.rotations.size());
  CHECK(close_turned(solid, scale, ample_turned(largest), orientation, box) ==
        reference::close_oriented(solid, scale, sample(orientation, seen), box));
}

/// One random field, closed whole and in tiles of one random size, each with its own halo and nothing else. Returns the
/// tiles that differ.
int compare_turned_tiles(std::uint64_t seed) {
  Random random(seed);
  const VoxelBox grid = reference::random_box(random, 80);
  const BitBox solid = reference::random_solid(random, grid);
  const GridFrame frame;
  const ScaleField field = reference::random_field(random, grid, 9);
  const VoxelBox box = grid.grown(10);
  const OrientationField orientation = reference::random_orientation(random, box);
  const Halo all = ample_turned(field.upper_bound(frame));
  const BitBox whole = close_turned(solid, field.sample(frame, box.grown(all.total_vox())), all, orientation, box);
  const VoxelCoord side{random.between(5, 70), random.between(5, 40), random.between(5, 40)};
  int wrong = 0;
  for (std::int32_t z = box.min.z; z < box.max.z; z += side.z) {
    for (std::int32_t y = box.min.y; y < box.max.y; y += side.y) {
      for (std::int32_t x = box.min.x; x < box.max.x; x += side.x) {
        const VoxelBox tile = intersect({{x, y, z}, VoxelCoord{x, y, z} + side}, box);
        const Halo halo = halo_of(tile, field, frame, {StructuringElement::cube, &orientation});
        CHECK(halo.dilation_vox <= all.dilation_vox);
        const BitBox part = reference::cut(solid, tile.grown(halo.total_vox()));
        const BitBox closed = close_turned(part, field.sample(frame, part.box()), halo, orientation, tile);
        wrong += reference::cut(closed, tile) == reference::cut(whole, tile) ? 0 : 1;
      }
    }
  }
  return wrong;
}

OrientationField one_rotation(const FixedQuaternion& q) {
  return {64, {}, {1, 1, 1}, {q}, {0}};
}

OrientationField orientation_of(Random& random, const VoxelBox& box, std::int32_t edge, bool about_z) {
  OrientationField f{edge, {}, {}, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    f.origin[axis] = floor_div(box.min[axis], edge);
    f.size[axis] = ceil_div(box.max[axis], edge) - f.origin[axis];
  }
  const auto part = [&] { return std::int16_t(random.between(-16000, 16000)); };
  for (int i = 0; i < 3; ++i)
    f.rotations.push_back(about_z ? FixedQuaternion{12000, 0, 0, part()}
                                  : FixedQuaternion{12000, part(), part(), part()});
  for (int i = 0; i < f.size.x * f.size.y * f.size.z; ++i) f.cells.push_back(std::uint16_t(random.between(0, 2)));
  return f;
}

/// Voxels of a small box whose dilation by large cubes differs from the definition: a few points around it.
int compare_large(std::uint64_t seed) {
  Random random(seed);
  const Scale largest = Scale(random.between(20 * kScaleOne, 90 * kScaleOne)),
              least = seed % 2 == 0 ? largest : Scale(random.between(largest / 2, largest));
  VoxelBox region;
  region.min = {random.between(-200, 150), random.between(-20, 20), random.between(-20, 20)};
  region.max = region.min + VoxelCoord{random.between(1, 140), random.between(1, 20), random.between(1, 20)};
  BitBox out(region);
  const VoxelBox box = out.box(), seen = box.grown(oriented_reach(largest) + 1);
  BitBox solid(seen);
  std::vector<VoxelCoord> points;
  for (int i = random.between(1, 6); i > 0; --i) {
    points.push_back({random.between(seen.min.x, seen.max.x - 1), random.between(seen.min.y, seen.max.y - 1),
                      random.between(seen.min.z, seen.max.z - 1)});
    solid.set(points.back());
  }
  ScaleLattice scale = reference::random_lattice(random, box, largest);
  for (Scale& s : scale.samples) s = Scale(random.between(least, largest));
  scale.min = *std::min_element(scale.samples.begin(), scale.samples.end());
  scale.max = *std::max_element(scale.samples.begin(), scale.samples.end());
  const OrientationField field = orientation_of(random, box, seed % 4 == 0 ? 8 : 64, seed % 5 == 0);
  detail::OrientedDilation dilation;
  if (!dilation.turns(field, box)) return 0;
  dilation.run(solid, scale, out);
  int wrong = 0;
  for_each(region, [&](VoxelCoord p) {
    const Rotation r = canonical(rotation_of(field.rotations[field.index_at(p)]));
    const bool held = std::any_of(points.begin(), points.end(), [&](VoxelCoord q) {
      return in_oriented_cube(r, scale.at(p), q.x - p.x, q.y - p.y, q.z - p.z);
    });
    wrong += held == out.test(p) ? 0 : 1;
  });
  return wrong;
}

Rotation random_rotation(Random& random) {
  const auto part = [&] { return std::int16_t(random.between(-16000, 16000)); };
  return canonical(rotation_of(FixedQuaternion{12000, part(), part(), part()}));
}

}  // namespace

TEST_CASE("the closing by turned cubes equals its definition on small grids", "[quick][closing][oriented]") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) compare_turned(seed, 9, 3);
}

TEST_CASE("the closing by turned cubes equals its definition on many random grids", "[property][closing][oriented]") {
  for (std::uint64_t seed = 1000; seed < 1600; ++seed) compare_turned(seed, 15, 4);
  for (std::uint64_t seed = 3000; seed < 3030; ++seed) compare_turned(seed, 6, 9);
}

TEST_CASE("large turned cubes hold what their definition says", "[quick][closing][oriented]") {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    CAPTURE(seed);
    CHECK(compare_large(seed) == 0);
  }
}

TEST_CASE("a field of very many rotations is closed at once, and as by each cube once", "[quick][closing][oriented]") {
  OrientationField field{8, {}, {256, 256, 1}, {}, {}};
  for (std::uint32_t i = 0; i < OrientationField::kMostRotations; ++i)
    field.rotations.push_back({16000, std::int16_t(i % 128 * 8), std::int16_t(i / 256 * 8), 1});
  for (std::uint32_t i = 0; i < 1U << 16; ++i)
    field.cells.push_back(std::uint16_t(std::min(i, OrientationField::kMostRotations - 1)));
  REQUIRE(orientation_fault(field) == nullptr);
  detail::OrientedDilation dilation;
  CHECK(dilation.turns(field, {{0, 0, 0}, {2048, 2048, 8}}));
  const OrientationField once = each_cube_once(field);
  CHECK(once.rotations.size() < field.rotations.size());
  for (std::size_t i = 0; i < field.cells.size(); i += 97)
    CHECK(canonical(rotation_of(once.rotations[once.cells[i]])) ==
          canonical(rotation_of(field.rotations[field.cells[i]])));
  field.rotations.push_back({});
  CHECK(orientation_fault(field) != nullptr);
}

TEST_CASE("turned cubes close tile by tile as on the whole grid", "[quick][closing][oriented]") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    CHECK(compare_turned_tiles(seed) == 0);
  }
}

TEST_CASE("turned cubes close tile by tile as on the whole grid for many fields", "[property][closing][oriented]") {
  for (std::uint64_t seed = 100; seed < 250; ++seed) {
    CAPTURE(seed);
    CHECK(compare_turned_tiles(seed) == 0);
  }
}

TEST_CASE("the 24 turns of a cube onto itself close like the cube", "[quick][closing][oriented]") {
  constexpr std::int16_t k = 1 << kRotationBits, h = k / 2;
  Random random(5);
  const VoxelBox box = reference::random_box(random, 40);
  const BitBox solid = reference::random_solid(random, box);
  const ScaleLattice scale = reference::random_lattice(random, box.grown(12), 6 * kScaleOne);
  ClosingScratch scratch;
  BitBox cube;
  close_tile(solid, scale, ample_turned(scale.max), {}, box, cube, scratch);
  for (const FixedQuaternion q : {FixedQuaternion{}, FixedQuaternion{0, k, 0, 0}, FixedQuaternion{k, 0, 0, k},
                                  FixedQuaternion{h, h, -h, h}, FixedQuaternion{0, k, -k, 0}}) {
    const OrientationField field = one_rotation(q);
    CHECK(canonical(rotation_of(q)) == Rotation{});
    CHECK(oriented_reach(field, 100) == cube_radius(100));
    CHECK(close_turned(solid, scale, ample_turned(scale.max), field, box) == cube);
  }
}

TEST_CASE("boxes around and inside a turned cube hold for every rotation and scale", "[quick][closing][oriented]") {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const Rotation r = random_rotation(random);
    const auto s = Scale(random.between(0, 12 * kScaleOne));
    const CubeBounds bounds = cube_bounds(r);
    const detail::CubeRows rows(r, s);
    const std::int32_t inner = bounds.inner(s) / kScaleOne, outer = bounds.reach(s), far = oriented_reach(s) + 1;
    CHECK(outer <= oriented_reach(s));
    std::int64_t held = 0, in_rows = 0;
    for (std::int32_t z = -far; z <= far; ++z) {
      for (std::int32_t y = -far; y <= far; ++y) {
        for (std::int32_t x = -far; x <= far; ++x) {
          const bool in = in_oriented_cube(r, s, x, y, z);
          const std::int32_t away = std::max({std::abs(x), std::abs(y), std::abs(z)});
          held += in ? 1 : 0;
          if ((away <= inner && !in) || (away > outer && in)) FAIL_CHECK("rotation " << i << ", scale " << s);
        }
      }
    }
    for (std::int32_t dz = -rows.reach(); dz <= rows.reach(); ++dz) {
      const auto slice = rows.rows(dz, -rows.reach(), rows.reach() + 1);
      for (std::int32_t dy = slice.begin; dy < slice.end; ++dy) {
        const detail::CubeRow row = slice.rows[dy - slice.begin];
        in_rows += std::max(row.last - row.first + 1, 0);
      }
    }
    CHECK(held == in_rows);
  }
}

TEST_CASE("voxels twice as large hold what the eight in them hold", "[quick][closing][oriented]") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const VoxelBox box = reference::random_box(random, 90);
    const BitBox solid = reference::random_solid(random, box);
    BitBox large(halved(box).grown(random.between(-2, 3))), small(box);
    detail::halve(solid, large);
    int wrong = 0;
    for_each(large.box(), [&](VoxelCoord p) {
      bool any = false;
      for (int i = 0; i < 8; ++i) any = any || solid.test(p * 2 + VoxelCoord{i % 2, i / 2 % 2, i / 4});
      wrong += any == large.test(p) ? 0 : 1;
    });
    BitBox all(halved(small.box()));
    detail::halve(solid, all);
    detail::double_up(all, small);
    for_each(small.box(), [&](VoxelCoord p) {
      const VoxelCoord in{floor_div(p.x, 2), floor_div(p.y, 2), floor_div(p.z, 2)};
      wrong += small.test(p) == all.test(in) ? 0 : 1;
    });
    CAPTURE(seed);
    CHECK(wrong == 0);
  }
}

TEST_CASE("what turned cubes of large voxels decide holds for every voxel in them", "[quick][closing][oriented]") {
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    const Rotation r = random_rotation(random);
    const auto s = Scale(random.between(0, 12 * kScaleOne));
    const std::int32_t edge = random.between(1, 2) * 2, far = s / kScaleOne + 2;
    const CoarseScale coarse = coarse_scale(cube_bounds(r).row_sum, s, edge);
    int wrong = 0;
    for_each(VoxelBox{{-far, -far, -far}, {far, far, far}}, [&](VoxelCoord d) {
      bool all = true, any = false;
      for_each(VoxelBox{{1 - edge, 1 - edge, 1 - edge}, {edge, edge, edge}}, [&](VoxelCoord between) {
        const VoxelCoord apart = d * edge + between;
        const bool in = in_oriented_cube(r, s, apart.x, apart.y, apart.z);
        all = all && in;
        any = any || in;
      });
      const bool sure = coarse.sure >= 0 && in_oriented_cube(r, Scale(coarse.sure), d.x, d.y, d.z),
                 possible = in_oriented_cube(r, Scale(coarse.possible), d.x, d.y, d.z);
      wrong += (sure && !all) || (any && !possible) ? 1 : 0;
    });
    CAPTURE(i, s, edge);
    CHECK(wrong == 0);
  }
}
