#include <random>

#include "lib/volume/openings.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// Blocks, plates and poles, at random.
BitBox random_solid(std::uint32_t seed, const VoxelBox& box) {
  std::mt19937 random(seed);
  BitBox solid(box);
  const auto below = [&](std::int32_t n) { return std::int32_t(random() % std::uint32_t(n)); };
  for (int i = 0; i < 80; ++i) {
    VoxelBox block;
    for (int axis = 0; axis < 3; ++axis) {
      block.min[axis] = box.min[axis] + below(box.size()[axis]);
      block.max[axis] = std::min(box.max[axis], block.min[axis] + 1 + below(i < 74 ? 2 : i % 3 == axis ? 3 : 14));
    }
    for_each(block, [&](VoxelCoord p) { solid.set(p); });
  }
  // Two walls, with a gap of four voxels between them.
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t x = 5; x < box.max.x; ++x) {
      solid.set({x, -3, z});
      solid.set({x, 2, z});
    }
  }
  return solid;
}

/// True if one of the voxels within reach `r` of p is.
template <class Is>
bool any_within(VoxelCoord p, std::int32_t r, const Is& is) {
  bool any = false;
  for_each(VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}}.grown(r), [&](VoxelCoord q) { any = any || is(q); });
  return any;
}

/// The definitions, voxel by voxel.
struct Plain {
  explicit Plain(const BitBox& of) : solid(of) {
    constexpr std::int32_t kFar = 4;  // no reach is larger
    for_each(solid.box(), [&](VoxelCoord p) {
      std::int32_t r = 0;
      while (r < kFar && !any_within(p, r, [&](VoxelCoord q) { return solid.test(q); })) ++r;
      distance.push_back(r);
    });
  }
  const BitBox& solid;
  std::vector<std::int32_t> distance;  // Chebyshev, to the nearest solid voxel

  [[nodiscard]] bool is_free(VoxelCoord p, std::int32_t r) const {
    const VoxelBox& box = solid.box();
    const VoxelCoord at = p - box.min, size = box.size();
    return distance.at(std::size_t((at.z * size.y + at.y) * size.x + at.x)) > r;
  }
  [[nodiscard]] bool held(VoxelCoord p, std::int32_t r) const {
    return any_within(p, r, [&](VoxelCoord q) { return is_free(q, r); });
  }
  [[nodiscard]] bool thin(VoxelCoord p, std::int32_t h) const {
    const auto thick = [&](VoxelCoord q) { return !any_within(q, h, [&](VoxelCoord g) { return !solid.test(g); }); };
    return solid.test(p) && !any_within(p, 3 * h, thick);
  }
  [[nodiscard]] bool middle(VoxelCoord p, std::int32_t above, std::int32_t reach) const {
    return is_free(p, reach) && any_within(p, reach, [&](VoxelCoord q) { return held(q, reach) && !held(q, above); });
  }
};

/// A whole solid, and the part that is asked about: functions see only the part with the context that they ask for.
struct Scene {
  explicit Scene(std::uint32_t seed, std::int32_t context)
      : tile({{3, -3, 3}, {8, 3, 6}}),
        solid(random_solid(seed, {{-64, -17, -11}, {64, 18, 22}})),
        seen(tile.grown(context)) {
    for_each(tile.grown(context), [&](VoxelCoord p) {
      if (solid.test(p)) seen.set(p);
    });
  }
  VoxelBox tile;
  BitBox solid, seen;
};

}  // namespace

TEST_CASE("narrow places are those that no free cube holds", "[quick][grid]") {
  const std::int32_t r = GENERATE(0, 1, 2, 3);
  const Scene s(GENERATE(1u, 2u), 2 * r);
  const BitBox narrow = narrow_places(s.seen, r);
  const Plain plain(s.solid);
  bool same = true;
  for_each(s.tile, [&](VoxelCoord p) { same = same && narrow.test(p) == (!s.solid.test(p) && !plain.held(p, r)); });
  CHECK(same);
}

TEST_CASE("thin parts are what lies away from all solid cubes", "[quick][grid]") {
  const std::int32_t h = GENERATE(1, 2);
  const Scene s(GENERATE(1u, 2u, 3u), 4 * h);
  const BitBox thin = thin_parts(s.seen, h);
  const Plain plain(s.solid);
  bool same = true;
  for_each(s.tile, [&](VoxelCoord p) { same = same && thin.test(p) == plain.thin(p, h); });
  CHECK(same);
}

TEST_CASE("openings are found by width, and near what is asked for", "[quick][grid]") {
  const std::vector<std::int32_t> reaches{3, 2, 0};
  const Scene s(GENERATE(1u, 2u), 4 * reaches[0] + 1);
  BitBox near(s.seen.box());
  for_each(near.box(), [&](VoxelCoord p) {
    if (p.x < 6 && s.seen.test(p)) near.set(p);
  });
  const bool by_part = GENERATE(false, true);
  std::vector<BitBox> found(reaches.size());
  openings(s.seen, by_part ? &near : nullptr, reaches, s.tile,
           [&](std::size_t k, const BitBox& voxels) { found[k] = voxels; });
  const Plain plain(s.solid);
  std::size_t wrong = 0, some = 0;
  for (std::size_t k = 1; k < reaches.size(); ++k) {
    const std::int32_t above = reaches[k - 1], reach = reaches[k];
    const auto is_middle = [&](VoxelCoord p) {
      return plain.middle(p, above, reach) &&
             (!by_part || any_within(p, above + 1, [&](VoxelCoord q) { return near.test(q); }));
    };
    for_each(s.tile, [&](VoxelCoord p) {
      const bool is_place = plain.held(p, reach) && !plain.held(p, above);
      const bool expected = is_middle(p) || (is_place && any_within(p, reach, is_middle));
      wrong += found[k].test(p) != expected;
      some += expected;
    });
  }
  CHECK(wrong == 0);
  CHECK(some > 0);
}
