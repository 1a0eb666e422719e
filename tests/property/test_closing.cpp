#include <algorithm>

#include "lib/closing/closing_scratch.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"

using namespace bp;
using reference::Random;

namespace {

StructuringElement random_element(Random& random) {
  return random.one_in(2) ? StructuringElement::cube : StructuringElement::ball;
}

/// Returns a halo that suffices for any scale up to `largest`.
Halo ample(Scale largest) {
  return {largest / kScaleOne + 2, largest / kScaleOne + 1};
}

BitBox close_box(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, StructuringElement element,
                 const VoxelBox& box) {
  static ClosingScratch scratch;  // kept on purpose: what a call leaves behind must not matter to the next
  BitBox closed;
  close_tile(solid, scale, halo, {element}, box, closed, scratch);
  return closed;
}

/// Occupied voxels of `tile` in which `a` and `b` differ.
std::int64_t differences(const BitBox& a, const BitBox& b, const VoxelBox& tile) {
  std::int64_t n = 0;
  for (std::int32_t z = tile.min.z; z < tile.max.z; ++z) {
    for (std::int32_t y = tile.min.y; y < tile.max.y; ++y) {
      for (std::int32_t x = tile.min.x; x < tile.max.x; ++x) n += a.test({x, y, z}) != b.test({x, y, z}) ? 1 : 0;
    }
  }
  return n;
}

bool subset(const BitBox& a, const BitBox& b) {
  for (std::int32_t z = a.box().min.z; z < a.box().max.z; ++z) {
    for (std::int32_t y = a.box().min.y; y < a.box().max.y; ++y) {
      for (std::int32_t x = a.box().min.x; x < a.box().max.x; ++x) {
        if (a.test({x, y, z}) && !b.test({x, y, z})) return false;
      }
    }
  }
  return true;
}

/// One random case against the definition.
void compare_with_definition(std::uint64_t seed, std::int32_t longest, std::int32_t largest_vox) {
  Random random(seed);
  const VoxelBox grid = reference::random_box(random, longest);
  const BitBox solid = reference::random_solid(random, grid);
  const auto largest = Scale(random.between(0, largest_vox * kScaleOne));
  const VoxelBox box = grid.grown(random.between(0, 3));
  const ScaleLattice scale = reference::random_lattice(random, box.grown(largest / kScaleOne + 3), largest);
  const StructuringElement element = random_element(random);
  CAPTURE(seed, int(element), largest, scale.constant());
  const BitBox closed = close_box(solid, scale, ample(largest), element, box);
  const BitBox expected = reference::close(solid, scale, element, box);
  CHECK(closed.box() == expected.box());
  CHECK(differences(closed, expected, closed.box()) == 0);
  CHECK(subset(reference::cut(solid, box), closed));
  CHECK(subset(closed, reference::dilate(solid, scale, element, box)));
}

/// One random field, closed whole and in tiles of one random size, each tile given its own halo and nothing else.
/// Returns the voxels that differ.
std::int64_t compare_tiles(std::uint64_t seed) {
  Random random(seed);
  const VoxelBox grid = reference::random_box(random, 80);
  const BitBox solid = reference::random_solid(random, grid);
  const GridFrame frame;
  const ScaleField field = reference::random_field(random, grid, 9);
  const StructuringElement element = random_element(random);
  const Halo all = ample(field.upper_bound(frame));
  const VoxelBox box = grid.grown(10);
  const BitBox whole = close_box(solid, field.sample(frame, box.grown(all.total_vox())), all, element, box);
  const VoxelCoord side{random.between(5, 70), random.between(5, 40), random.between(5, 40)};
  std::int64_t wrong = 0;
  for (std::int32_t z = box.min.z; z < box.max.z; z += side.z) {
    for (std::int32_t y = box.min.y; y < box.max.y; y += side.y) {
      for (std::int32_t x = box.min.x; x < box.max.x; x += side.x) {
        const VoxelBox tile = intersect({{x, y, z}, VoxelCoord{x, y, z} + side}, box);
        const Halo halo = halo_of(tile, field, frame);
        CHECK(halo.erosion_vox <= all.erosion_vox);
        CHECK(halo.dilation_vox <= all.dilation_vox);
        const BitBox part = reference::cut(solid, tile.grown(halo.total_vox()));
        const ScaleLattice scale = field.sample(frame, part.box());
        wrong += differences(whole, close_box(part, scale, halo, element, tile), tile);
      }
    }
  }
  return wrong;
}

ScaleLattice constant_lattice(const VoxelBox& box, double scale_vox) {
  ScaleField field;
  field.base = scale_vox;
  return field.sample(GridFrame{}, box);
}

}  // namespace

TEST_CASE("the closing equals its definition on small grids", "[quick][closing]") {
  for (std::uint64_t seed = 0; seed < 150; ++seed) compare_with_definition(seed, 9, 3);
}

TEST_CASE("the closing equals its definition on a thousand random grids", "[property][closing]") {
  for (std::uint64_t seed = 1000; seed < 2200; ++seed) compare_with_definition(seed, 15, 4);
}

TEST_CASE("the closing equals its definition on small objects in wide scales", "[property][closing]") {
  for (std::uint64_t seed = 3000; seed < 3040; ++seed) compare_with_definition(seed, 6, 10);
}

TEST_CASE("closing tile by tile equals closing the whole grid", "[quick][closing]") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    CHECK(compare_tiles(seed) == 0);
  }
}

TEST_CASE("closing tile by tile equals closing the whole grid for many fields and tile sizes", "[property][closing]") {
  for (std::uint64_t seed = 100; seed < 400; ++seed) {
    CAPTURE(seed);
    CHECK(compare_tiles(seed) == 0);
  }
}

TEST_CASE("a halo one voxel short is noticed", "[quick][closing]") {
  // Finds the farthest voxel that can matter, for p = (-1, 0, 0) at the tile's border: S is 1 up to x = 8 and 17.5 from
  // x = 16 on, so q = (16, 0, 0) is the only contour voxel that reaches p. It is contour because its neighbour (17, 0,
  // 0) is in the dilation, due to g, 17 voxels on. Without g, p stays.
  const GridFrame frame;
  ScaleField field;
  field.base = 1;
  field.rules.push_back(box_rule({16, -1000, -1000}, {1000, 1000, 1000}, 17.5));
  const VoxelBox tile{{-64, -8, -8}, {0, 8, 8}};
  const Halo halo = halo_of(tile, field, frame);
  CHECK(halo.erosion_vox == 17 + 1);
  CHECK(halo.dilation_vox == 17);
  const VoxelCoord p{-1, 0, 0}, g{34, 0, 0};
  BitBox solid(tile.grown(halo.total_vox()));
  solid.set({-2, 0, 0});
  solid.set(g);
  const ScaleLattice scale = field.sample(frame, tile.grown(halo.total_vox()));
  const auto closed_p = [&](std::int32_t missing) {
    const BitBox part = reference::cut(solid, tile.grown(halo.total_vox() - missing));
    return close_box(part, scale, halo, StructuringElement::cube, tile).test(p);
  };
  CHECK_FALSE(closed_p(0));
  CHECK(closed_p(1));
}

TEST_CASE("closing twice with one ball changes nothing more", "[quick][closing]") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const VoxelBox grid = reference::random_box(random, 60), box = grid.grown(30);
    const ScaleLattice scale = constant_lattice(box.grown(30), random.between(0, 12 * 16) / 16.0);
    const BitBox once =
        close_box(reference::random_solid(random, grid), scale, ample(scale.max), StructuringElement::ball, box);
    CHECK(close_box(once, scale, ample(scale.max), StructuringElement::ball, box) == once);
  }
}

TEST_CASE("the closing of a part lies inside the closing of the whole", "[quick][closing]") {
  // The closing is increasing for one radius everywhere. (A contour voxel of the larger set may lie where a varying
  // scale is larger.)
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const VoxelBox grid = reference::random_box(random, 40), box = grid.grown(12);
    BitBox part = reference::random_solid(random, grid), whole = reference::random_solid(random, grid);
    for (std::int64_t i = 0; i < whole.word_count(); ++i) whole.data()[i] |= part.data()[i];
    const ScaleLattice scale = constant_lattice(box.grown(20), random.between(0, 8 * 16) / 16.0);
    const StructuringElement element = random_element(random);
    CHECK(subset(close_box(part, scale, ample(scale.max), element, box),
                 close_box(whole, scale, ample(scale.max), element, box)));
  }
}

TEST_CASE("the closing moves with the grid and its scale field", "[quick][closing]") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const VoxelBox grid = reference::random_box(random, 50), box = grid.grown(8);
    const BitBox solid = reference::random_solid(random, grid);
    const StructuringElement element = random_element(random);
    // It is invariant under any offset if the scale is constant, else under offsets of whole lattice cells.
    const bool constant = random.one_in(2);
    VoxelCoord offset{random.between(-70, 70), random.between(-70, 70), random.between(-70, 70)};
    if (!constant) offset = {offset.x / 8 * 8, offset.y / 8 * 8, offset.z / 8 * 8};
    ScaleLattice scale = reference::random_lattice(random, box.grown(12), 6 * kScaleOne);
    if (constant) scale = constant_lattice(box.grown(12), 6.3);
    ScaleLattice moved_scale = scale;
    for (int axis = 0; axis < 3; ++axis) moved_scale.origin[axis] += offset[axis] / 8;
    const VoxelBox moved_box{box.min + offset, box.max + offset};
    if (constant) moved_scale = constant_lattice(moved_box.grown(12), 6.3);
    BitBox moved(VoxelBox{grid.min + offset, grid.max + offset});
    for (std::int32_t z = grid.min.z; z < grid.max.z; ++z) {
      for (std::int32_t y = grid.min.y; y < grid.max.y; ++y) {
        for (std::int32_t x = grid.min.x; x < grid.max.x; ++x) {
          if (solid.test({x, y, z})) moved.set(VoxelCoord{x, y, z} + offset);
        }
      }
    }
    const BitBox a = close_box(solid, scale, ample(scale.max), element, box);
    const BitBox b = close_box(moved, moved_scale, ample(scale.max), element, moved_box);
    bool same = true;
    for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
      for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
        for (std::int32_t x = box.min.x; x < box.max.x; ++x)
          same = same && a.test({x, y, z}) == b.test(VoxelCoord{x, y, z} + offset);
      }
    }
    CHECK(same);
  }
}

TEST_CASE("a scale below one voxel changes nothing", "[quick][closing]") {
  Random random(7);
  const VoxelBox grid{{-70, -3, 0}, {75, 20, 21}};
  for (const double scale_vox : {0.0, 0.5, 15.0 / 16}) {
    const BitBox solid = reference::random_solid(random, grid);
    const ScaleLattice scale = constant_lattice(grid.grown(4), scale_vox);
    for (const StructuringElement element : {StructuringElement::cube, StructuringElement::ball})
      CHECK(differences(close_box(solid, scale, ample(scale.max), element, grid), solid, grid) == 0);
  }
}

TEST_CASE("nothing stays nothing and a full tile stays full", "[quick][closing]") {
  const VoxelBox tile{{0, 0, 0}, {128, 64, 64}};
  const ScaleLattice scale = constant_lattice(tile.grown(44), 20);
  BitBox solid(tile.grown(41));
  CHECK(close_box(solid, scale, {21, 20}, StructuringElement::cube, tile).count() == 0);
  std::fill_n(solid.data(), solid.word_count(), ~std::uint64_t(0));
  CHECK(close_box(solid, scale, {21, 20}, StructuringElement::cube, tile).count() == std::uint64_t(tile.volume()));
}

TEST_CASE("scales beyond 128 voxels keep their exact distances", "[quick][closing]") {
  // One voxel, one ball of radius S around it: D is that ball, E the voxel alone. Two voxels 2 S - 2 apart along x: the
  // contours of the two balls meet only off the axis, so the closing joins nothing; brute force would take minutes.
  const VoxelBox box{{-8, -8, -8}, {9, 9, 9}};
  BitBox solid(box);
  solid.set({0, 0, 0});
  for (const double scale_vox : {126.5, 128.0, 128.0625, 150.0, 300.0}) {
    CAPTURE(scale_vox);
    const ScaleLattice scale = constant_lattice(box.grown(310), scale_vox);
    const BitBox closed = close_box(solid, scale, ample(scale.max), StructuringElement::ball, box);
    CHECK(closed == solid);
    // The cube of radius floor(S) around the voxel loses all but the voxels at least S from its contour at floor(S) +
    // 1: a cube of half side floor(floor(S) + 1 - S).
    const BitBox cube = close_box(solid, scale, ample(scale.max), StructuringElement::cube, box);
    const bool whole = scale_vox == double(int(scale_vox));
    CHECK(cube.count() == (whole ? 27U : 1U));
  }
}
