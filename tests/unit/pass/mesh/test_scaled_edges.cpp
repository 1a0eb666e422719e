#include "lib/core/vec3.h"
#include "lib/grid/scale_field.h"
#include "lib/pass/mesh/detail/scaled_edges.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"
#include "tests/unit/grid/random_fields.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Returns whether S reaches the scale at the ends of a line and at points of it that are at most a voxel apart.
bool reaches_along(const ScaleField& field, const Vec3d& a, const Vec3d& b, double scale, double voxel) {
  const Vec3d middle = 0.5 * (a + b);
  if (field.evaluate(middle) < scale) return false;
  if (length(a - b) <= voxel) return field.evaluate(a) >= scale && field.evaluate(b) >= scale;
  return reaches_along(field, a, middle, scale, voxel) && reaches_along(field, middle, b, scale, voxel);
}

}  // namespace

TEST_CASE("an edge is as long as the scale allows all along it, for few rules and for many", "[quick][mesh]") {
  const auto seed = GENERATE(range(0u, 12u));
  ScaleField field = random_field(seed);
  Random random(seed + 100);
  if (seed % 3 == 0) field.rules.resize(5);
  GridFrame frame;
  frame.voxel = 0.5;
  frame.origin = {-3, 8, 1};
  const double factor = seed % 2 == 0 ? 4 : 1;
  const EdgeLimit limit = scaled_edges(field, frame, factor);
  int allowed = 0;
  constexpr int kEdges = 2000;
  for (int i = 0; i < kEdges; ++i) {
    const auto corner = [&](double reach) {
      const Vec3d p = random_point(random, reach);
      return LatticeCoord{std::int64_t(p[0]), std::int64_t(p[1]), std::int64_t(p[2])};
    };
    const LatticeCoord a = corner(60 * kLatticePerVoxel), b = a + corner(i % 50 == 0 ? 5000 : 6 * kLatticePerVoxel);
    const double edge = length(to_double(b - a));
    const bool expected =
        edge <= 2 * kLatticePerVoxel || reaches_along(field, frame.world(a), frame.world(b),
                                                      edge / kLatticePerVoxel * frame.voxel / factor, frame.voxel);
    CHECK(limit(a, b) == expected);
    allowed += expected ? 1 : 0;
  }
  CHECK(allowed > kEdges / 100);
}

TEST_CASE("an edge among many boxes of a scale costs a few points of the field, and nothing when it is asked again",
          "[quick][mesh]") {
  ScaleField field;
  field.base = 0.1;
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 30; ++k) {
      ScaleRule& rule = field.rules.emplace_back();
      rule.shape = ScaleShape::box;
      rule.points = {{0.4 * i, 0, 0.4 * k}, {0.4 * i + 0.4, 0.2, 0.4 * k + 0.4}};
      rule.scale = 0.2;
    }
  }
  GridFrame frame;
  frame.voxel = 0.2;
  ScaledEdgeWork work;
  const EdgeLimit limit = scaled_edges(field, frame, 4, nullptr, &work);
  Random random(1);
  constexpr int kEdges = 2000;
  int allowed = 0;
  for (int round = 0; round < 2; ++round) {
    random = Random(1);
    const std::uint64_t before = work.points;
    for (int i = 0; i < kEdges; ++i) {
      const auto on_plane = [&](double x, double z, double reach) {
        const Vec3d p = random_point(random, reach);
        return LatticeCoord{std::int64_t(x + p[0]), kLatticePerVoxel / 2, std::int64_t(z + p[2])};
      };
      const LatticeCoord a = on_plane(30.0 * kLatticePerVoxel, 30.0 * kLatticePerVoxel, 25.0 * kLatticePerVoxel);
      allowed += limit(a, on_plane(double(a.x), double(a.z), 2.5 * kLatticePerVoxel)) ? 1 : 0;
    }
    if (round > 0) CHECK(work.points - before < kEdges / 10);
  }
  CHECK(allowed > kEdges);
  CHECK(work.points < 5 * kEdges);  // 8 at each edge if all were asked that a voxel is halved to
  CHECK(work.parts < 3 * kEdges);
  INFO(work.points << " points, " << work.parts << " parts");
}

TEST_CASE("an edge near the voxels may be longer than the scale allows, by an eighth of the longest edge and a voxel",
          "[quick][mesh]") {
  constexpr std::int32_t kSide = 128;
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {kSide, kSide, kSide}}, [](VoxelCoord) { return true; });
  ScaleField field;
  field.base = 16;
  ScaleRule& rule = field.rules.emplace_back();
  rule.shape = ScaleShape::box;
  rule.points = {{0, 0, 0}, {40, 160, 160}};
  rule.scale = 2;
  const GridFrame frame;
  const EdgeLimit limit = scaled_edges(field, frame, 4, &shelf), without = scaled_edges(field, frame, 4);
  // An edge of 100 voxels along z, at a height above the top, which is flat.
  const auto allows = [&](const EdgeLimit& some, std::int64_t x, std::int64_t height) {
    const LatticeCoord a = LatticeCoord{x, kSide + height, 10} * kLatticePerVoxel;
    const LatticeCoord b = LatticeCoord{x, kSide + height, 110} * kLatticePerVoxel;
    return some(a, b);
  };
  for (const std::int64_t x : {20, 110}) CHECK_FALSE(allows(without, x, 0));
  CHECK(allows(limit, 20, 0));  // S is 2: 2 voxels
  CHECK_FALSE(allows(limit, 20, 5));
  CHECK(allows(limit, 110, 6));  // S is 16: 9 voxels
  CHECK_FALSE(allows(limit, 110, 13));
  CHECK(bytes_of_near_edges(field, frame, shelf) >= 2 * sizeof(BrickBits));
}

TEST_CASE("the part of a field near a place evaluates as all of it, also found within a larger part", "[quick][mesh]") {
  const auto seed = GENERATE(range(0u, 8u));
  const ScaleField field = random_field(seed);
  Random random(seed);
  for (int i = 0; i < 100; ++i) {
    const Vec3d centre = random_point(random, 40), offset = random_point(random, 2);
    const ScalePart outer = part_near(field, centre, 8), inner = part_near(field, centre + offset, 3, &outer);
    CHECK(inner.rules.size() <= outer.rules.size());
    for (int k = 0; k < 20; ++k) {
      const Vec3d p = centre + offset + random_point(random, 1.7);
      const double s = field.evaluate(p);
      CHECK(evaluate(field, outer, p) == s);
      CHECK(evaluate(field, inner, p) == s);
      CHECK(inner.range.least <= s);
      CHECK(inner.range.most >= s);
    }
  }
}

TEST_CASE("a thin box of a small scale is found between the ends of an edge", "[quick][mesh]") {
  ScaleField field;
  field.base = 8;
  field.rules.push_back(box_rule({-0.1, -1, -1}, {0.1, 1, 1}, 2));
  GridFrame frame;
  frame.voxel = 0.1;
  const EdgeLimit limit = scaled_edges(field, frame, 1);
  constexpr std::int64_t kUnit = 10 * kLatticePerVoxel;
  CHECK_FALSE(limit({-3 * kUnit, 0, 0}, {3 * kUnit, 0, 0}));
  CHECK(limit({-kUnit / 2, 0, 0}, {kUnit / 2, 0, 0}));
  CHECK(limit({-3 * kUnit, 0, 2 * kUnit}, {3 * kUnit, 0, 2 * kUnit}));
}
