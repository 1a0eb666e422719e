#include <algorithm>

#include "lib/closing/detail/ball_transform.h"
#include "lib/closing/detail/chessboard.h"
#include "lib/closing/detail/cube_dilation.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"

using namespace bp;
using reference::Random;

namespace {

/// A few voxels of a wide box, so that pairs can be tried one by one.
std::vector<VoxelCoord> scattered(Random& random, const VoxelBox& box, std::int32_t count) {
  std::vector<VoxelCoord> out;
  while (std::int32_t(out.size()) < count) {
    VoxelCoord p{random.between(box.min.x, box.max.x - 1), random.between(box.min.y, box.max.y - 1),
                 random.between(box.min.z, box.max.z - 1)};
    for (std::int32_t run = random.between(1, 9); run > 0 && p.x < box.max.x; --run, ++p.x) out.push_back(p);
  }
  return out;
}

void fill(detail::ColumnBits& bits, const VoxelBox& box, const std::vector<VoxelCoord>& voxels) {
  bits.reset(box);
  for (std::int32_t c = 0; c < bits.columns(); ++c) {
    for (std::int32_t z = box.min.z; z < box.max.z; ++z) std::fill_n(bits.slice(c, z), box.max.y - box.min.y, 0);
  }
  for (const VoxelCoord p : voxels)
    bits.slice((p.x - box.min.x) / 64, p.z)[p.y - box.min.y] |= std::uint64_t(1) << ((p.x - box.min.x) % 64);
}

bool test(const detail::ColumnBits& bits, VoxelCoord p) {
  return (bits.slice((p.x - bits.box().min.x) / 64, p.z)[p.y - bits.box().min.y] >> ((p.x - bits.box().min.x) % 64)) &
         1;
}

/// Returns whether some ball reaches p, by trying all pairs.
bool reached(const detail::BallRule& rule, const std::vector<VoxelCoord>& seeds, VoxelCoord p) {
  return std::any_of(seeds.begin(), seeds.end(), [&](VoxelCoord q) {
    const VoxelCoord d = p - q;
    const std::int64_t w = rule.scale == detail::BallScale::uniform   ? rule.bound
                           : rule.scale == detail::BallScale::at_seed ? ball_bound(rule.lattice->at(q))
                                                                      : ball_bound(rule.lattice->at(p));
    return std::int64_t(d.x) * d.x + std::int64_t(d.y) * d.y + std::int64_t(d.z) * d.z < w;
  });
}

}  // namespace

TEST_CASE("the ball transform equals all pairs of seeds and targets at any radius", "[quick][closing]") {
  detail::BallTransform transform;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const std::int32_t largest_vox = random.one_in(2) ? random.between(0, 140) : random.between(1, 9);
    const std::int32_t spread = largest_vox + random.between(1, 20);
    const VoxelBox targets_box{{64 * random.between(-2, 2), -random.between(1, 30), -7},
                               {64 * 4, spread / 2 + 1, spread}},
        seeds_box{{-64 * random.between(1, 3), -7, -spread / 2}, {64 * random.between(0, 3), 20, spread / 2 + 1}};
    const std::vector<VoxelCoord> seeds = scattered(random, seeds_box, random.between(1, 25)),
                                  targets = scattered(random, targets_box, 150);
    const ScaleLattice lattice =
        reference::random_lattice(random, hull(targets_box, seeds_box), Scale(largest_vox * kScaleOne));
    detail::BallRule rule{detail::BallScale(random.between(0, 2)), ball_bound(lattice.max), &lattice};
    CAPTURE(seed, largest_vox, int(rule.scale), lattice.constant());
    detail::ColumnBits q, p;
    fill(q, seeds_box, seeds);
    fill(p, targets_box, targets);
    transform.run(q, rule, p);
    std::int32_t wrong = 0;
    for (const VoxelCoord t : targets) wrong += test(p, t) != reached(rule, seeds, t) ? 1 : 0;
    CHECK(wrong == 0);
  }
}

TEST_CASE("cube dilations of one and of many radii equal all pairs at any radius", "[quick][closing]") {
  detail::VaryingCubeDilation varying;
  detail::CubeDilation constant;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const std::int32_t largest_vox = random.one_in(3) ? random.between(200, 300) : random.between(0, 70);
    const VoxelBox out_box{{-64, -20, -15}, {64, 21, 16}},
        solid_box{{64 * random.between(-3, 0), -largest_vox, -10}, {64 * random.between(1, 4), 10, largest_vox + 3}};
    const std::vector<VoxelCoord> voxels = scattered(random, solid_box, random.between(1, 12));
    BitBox solid(solid_box), out(out_box);
    for (const VoxelCoord g : voxels) solid.set(g);
    const ScaleLattice lattice = reference::random_lattice(random, out_box, Scale(largest_vox * kScaleOne));
    const bool one_radius = random.one_in(3);
    CAPTURE(seed, largest_vox, one_radius, lattice.constant());
    if (one_radius) {
      constant.run(solid, largest_vox, out);
    } else {
      varying.run(solid, lattice, out.box(), out);
    }
    std::int32_t wrong = 0;
    for (std::int32_t z = out_box.min.z; z < out_box.max.z; ++z) {
      for (std::int32_t y = out_box.min.y; y < out_box.max.y; ++y) {
        for (std::int32_t x = out_box.min.x; x < out_box.max.x; ++x) {
          const std::int32_t r = one_radius ? largest_vox : cube_radius(lattice.at({x, y, z}));
          const bool in = std::any_of(voxels.begin(), voxels.end(), [&](VoxelCoord g) {
            return std::abs(g.x - x) <= r && std::abs(g.y - y) <= r && std::abs(g.z - z) <= r;
          });
          wrong += in != out.test({x, y, z}) ? 1 : 0;
        }
      }
    }
    CHECK(wrong == 0);
  }
}
