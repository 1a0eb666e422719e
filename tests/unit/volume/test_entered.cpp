#include <random>

#include "lib/volume/entered.h"
#include "tests/catch.h"

using namespace bp;

namespace {

constexpr VoxelBox kYard{{0, 0, 0}, {64, 30, 30}};

/// Returns whether all voxels within reach of a middle, in the box, satisfy f.
template <class F>
bool all_near(VoxelCoord middle, VoxelCoord reach, const F& f) {
  bool all = true;
  for_each(intersect(kYard, VoxelBox{middle - reach, middle + reach + VoxelCoord{1, 1, 1}}),
           [&](VoxelCoord p) { all = all && f(p); });
  return all;
}

/// The definition: a walk of middles from a corner of the box.
BitBox defined(const BitBox& solid, VoxelCoord reach) {
  BitBox seen(kYard), entered(kYard);
  std::vector<VoxelCoord> left{kYard.min};
  seen.set(kYard.min);
  while (!left.empty()) {
    const VoxelCoord p = left.back();
    left.pop_back();
    (void)all_near(p, reach, [&](VoxelCoord q) { return entered.set(q), true; });
    for (const VoxelCoord d : {VoxelCoord{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
      const VoxelCoord q = p + d;
      if (!kYard.contains(q) || seen.test(q) || !all_near(q, reach, [&](VoxelCoord r) { return !solid.test(r); }))
        continue;
      seen.set(q);
      left.push_back(q);
    }
  }
  return entered;
}

/// A room from (8,6,6) to (40,24,24) with walls of two voxels: a door of 5 x 9, and a window of 9 x 5, z up.
bool room(VoxelCoord p) {
  constexpr VoxelBox outer{{8, 6, 6}, {40, 24, 24}}, door{{38, 10, 8}, {40, 15, 17}}, window{{8, 10, 14}, {10, 19, 19}};
  return outer.contains(p) && !outer.grown(-2).contains(p) && !door.contains(p) && !window.contains(p);
}

BitBox bits(const auto& touched) {
  BitBox all(kYard);
  for_each(kYard, [&](VoxelCoord p) {
    if (touched(p)) all.set(p);
  });
  return all;
}

}  // namespace

TEST_CASE("entered voxels are those of the definition", "[quick][volume][occluder]") {
  const auto reach = GENERATE(VoxelCoord{0, 0, 0}, VoxelCoord{1, 1, 3}, VoxelCoord{2, 4, 1}, VoxelCoord{2, 2, 4});
  std::mt19937 random(GENERATE(1u, 2u, 3u));
  std::vector<VoxelCoord> grains(12);
  for (VoxelCoord& g : grains)
    g = {6 + std::int32_t(random() % 50), 6 + std::int32_t(random() % 18), 6 + std::int32_t(random() % 18)};
  const BitBox solid = bits([&](VoxelCoord p) { return room(p) || std::count(grains.begin(), grains.end(), p) > 0; });
  CHECK(entered_voxels(solid, reach) == defined(solid, reach));
}

TEST_CASE("a body enters by a door, not by a window, and not if it is too tall", "[quick][volume][occluder]") {
  constexpr VoxelCoord inside{24, 15, 15};
  const auto enters = [&](VoxelCoord reach, const auto& touched) {
    return entered_voxels(bits(touched), reach).test(inside);
  };
  const auto shut = [](VoxelCoord p) { return room(p) || (p.x == 39 && p.y >= 10 && p.y < 15 && p.z < 17 && p.z > 7); };
  CHECK(enters({1, 1, 4}, room));
  CHECK_FALSE(enters({1, 1, 5}, room));
  CHECK_FALSE(enters({1, 1, 4}, shut));
  CHECK(enters({1, 1, 2}, shut));  // by the window
}

TEST_CASE("a body larger than the solid enters what one as large as the solid does", "[quick][volume][occluder]") {
  const int seed = GENERATE(range(0, 6));
  const VoxelBox bounds{{0, 0, 0}, {7, 6, 5}};
  std::mt19937 random(unsigned(seed) + 1);
  const auto entered_of = [&](const BitBox& touched, VoxelCoord reach) {
    BitBox solid(bounds.grown(31)), inside(bounds);
    copy_voxels(touched, solid);
    copy_voxels(entered_voxels(solid, reach), inside);
    return inside;
  };
  BitBox touched(bounds);
  for_each(bounds, [&](VoxelCoord p) {
    if (random() % 12 == 0) touched.set(p);
  });
  for (const VoxelCoord reach : {VoxelCoord{30, 1, 1}, {1, 20, 0}, {9, 8, 7}, {0, 0, 30}}) {
    const VoxelCoord clamped{std::min(reach.x, 7), std::min(reach.y, 6), std::min(reach.z, 5)};
    CHECK(entered_of(touched, reach) == entered_of(touched, clamped));
  }
}

TEST_CASE("a body holds its whole voxels wherever it stands", "[quick][volume][occluder]") {
  GridFrame frame;
  frame.voxel = 0.25;
  frame.up = GENERATE(UpAxis::y, UpAxis::minus_z);
  const double height = GENERATE(1.5, 1.8, 2.9, 6.0);
  const VoxelCoord reach = body_reach(frame, height, {100, 100, 100});
  const int up = frame.up == UpAxis::y ? 1 : 2;
  for (int axis = 0; axis < 3; ++axis) {
    const double width = axis == up ? height : height * kBodyWidth;
    std::int32_t least = 1000;
    for (double at = 0; at < 0.25; at += 1.0 / 512)
      least = std::min(least, std::int32_t(std::floor((at + width) / 0.25) - std::ceil(at / 0.25)));
    CHECK(2 * reach[axis] + 1 <= least);
    CHECK(2 * reach[axis] + 3 > least);
  }
}
