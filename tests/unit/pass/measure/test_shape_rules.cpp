#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/volume/dilate.h"
#include "lib/volume/openings.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tests/support/memory_scene.h"
#include "tests/support/memory_shelf.h"
#include "tests/support/voxel_source.h"

using namespace bp;

namespace {

struct Scene {
  explicit Scene(const BitBox& bits) : solid(voxels_of(bricks_of(bits.box()))) {
    copy_voxels(bits, solid);
    header.bricks = bricks_of(solid.box());
    store_voxels(solid, shelf);
  }
  StreamHeader header;
  BitBox solid;
  test::MemoryShelf shelf;

  [[nodiscard]] ScaleField with(const ShapeRule& rule, double base, MeasureOptions options = {}) const {
    ScaleField field;
    field.base = base;
    for (const ScaleRule& r : shape_rules(header, shelf, rule, field, options)) field.rules.push_back(r);
    return field;
  }
  [[nodiscard]] BitBox closed(const ScaleField& field, StructuringElement element, const VoxelBox& box) {
    Backends backends = test::plain_backends(2);
    CloseOptions options;
    options.keep_cavities = true;
    options.context.make_shelf = test::memory_shelves();
    BitBox out(box);
    load_voxels(*close_shelf(header, shelf, backends, field, {element}, options), out);
    return out;
  }
};

ShapeRule thickness(double length, double least = 0) {
  ShapeRule rule;
  rule.length = length;
  rule.least = least;
  return rule;
}

ShapeRule gap(double length, ScaleMode mode = ScaleMode::set) {
  ShapeRule rule;
  rule.kind = ShapeRule::Kind::gap;
  rule.length = length;
  rule.mode = mode;
  return rule;
}

void fill(BitBox& bits, const VoxelBox& box) {
  for_each(box, [&](VoxelCoord p) { bits.set(p); });
}

/// A wall, poles before it, and blocks with slits between them.
BitBox town() {
  BitBox bits(VoxelBox{{0, 0, 0}, {64, 44, 40}});
  fill(bits, {{4, 4, 4}, {60, 12, 30}});
  for (std::int32_t x = 8; x < 34; x += 8) fill(bits, {{x, 17, 4}, {x + 2, 19, 34}});
  fill(bits, {{4, 26, 4}, {20, 40, 20}});
  fill(bits, {{23, 26, 4}, {40, 40, 20}});
  fill(bits, {{49, 26, 4}, {60, 40, 20}});
  return bits;
}

/// Voxels that have to stay open under a base of 6.5: of each level, those farther from the solid than the scale.
BitBox wanted(const Scene& scene, const ShapeRule& rule, const VoxelBox& box) {
  const bool thin = rule.kind == ShapeRule::Kind::thickness;
  const std::vector<std::int32_t> levels =
      thin ? std::vector<std::int32_t>{6, 4, 2, 0} : std::vector<std::int32_t>{6, 3};
  const std::vector<std::int32_t> scales =
      thin ? std::vector<std::int32_t>{6, 2, 1, 0} : std::vector<std::int32_t>{6, 3};
  BitBox solid(box.grown(64)), parts, out(box);
  copy_voxels(scene.solid, solid);
  if (thin) parts = thin_parts(solid, 3);
  openings(solid, thin ? &parts : nullptr, levels, box, [&](std::size_t k, const BitBox& voxels) {
    BitBox level(box), near = solid;
    copy_voxels(voxels, level);
    dilate(near, scales[k]);
    BitBox close(box);
    copy_voxels(near, close);
    for (std::int64_t i = 0; i < out.word_count(); ++i) out.data()[i] |= level.data()[i] & ~close.data()[i];
  });
  return out;
}

}  // namespace

TEST_CASE("what a rule by shape keeps open stays open, with either element", "[quick][measure]") {
  const ShapeRule rule = GENERATE(thickness(4), gap(7));
  const auto element = GENERATE(StructuringElement::cube, StructuringElement::ball);
  Scene scene(town());
  const VoxelBox box = VoxelBox{{0, 0, 0}, {64, 44, 40}}.grown(12);
  ScaleField constant;
  constant.base = 6.5;
  const BitBox kept = scene.closed(scene.with(rule, constant.base), element, box);
  const BitBox lost = scene.closed(constant, element, box);
  const BitBox open = wanted(scene, rule, box);
  std::size_t closed = 0, closed_before = 0;
  for_each(box, [&](VoxelCoord p) {
    closed += open.test(p) && kept.test(p);
    closed_before += open.test(p) && lost.test(p);
  });
  CHECK(open.count() > 1000);
  CHECK(closed == 0);
  CHECK(closed_before > 500);
}

TEST_CASE("openings narrower than a gap close, and wider ones stay open", "[quick][measure]") {
  Scene scene(town());
  const VoxelBox box = VoxelBox{{0, 0, 0}, {64, 44, 40}}.grown(12);
  const VoxelCoord narrow{21, 33, 10}, wide{44, 33, 10};  // slits of 3 and 9 voxels
  const double base = GENERATE(0., 2., 9.);
  const auto is_closed = [&](const ShapeRule& rule, VoxelCoord p) {
    return scene.closed(scene.with(rule, base), StructuringElement::cube, box).test(p);
  };
  CHECK(is_closed(gap(6), narrow));
  CHECK(!is_closed(gap(6), wide));
  CHECK(is_closed(gap(6, ScaleMode::increase), narrow));
  CHECK(is_closed(gap(6, ScaleMode::increase), wide) == (base > 5));
  CHECK(is_closed(gap(6, ScaleMode::decrease), narrow) == (base >= 2));
  CHECK(!is_closed(gap(6, ScaleMode::decrease), wide));
}

TEST_CASE("only thin parts keep the openings beside them, down to the least scale", "[quick][measure]") {
  Scene scene(town());
  const VoxelBox box = VoxelBox{{0, 0, 0}, {64, 44, 40}}.grown(12);
  const VoxelCoord beside_pole{21, 18, 20}, between_blocks{21, 36, 10};
  const BitBox kept = scene.closed(scene.with(thickness(4), 6.5), StructuringElement::cube, box);
  CHECK(!kept.test(beside_pole));
  CHECK(kept.test(between_blocks));
  const BitBox coarse = scene.closed(scene.with(thickness(4, 5), 6.5), StructuringElement::cube, box);
  CHECK(coarse.test(beside_pole));
}

TEST_CASE("the scene's box bounds the memory and the time of a rule by shape", "[quick][measure]") {
  const Scene scene(town());
  MeasureOptions options;
  options.context.memory.bytes = std::uint64_t(48) << 20;
  const ScaleField all = scene.with(thickness(64), 60, options);  // the scene is 64 voxels long
  CHECK(!all.rules.empty());
  CHECK(scene.with(thickness(1e6), 60, options) == all);
  CHECK_THROWS_AS(scene.with(gap(1e6), 60, options), Error);
  options.context.memory.bytes = std::uint64_t(1) << 20;
  CHECK_THROWS_AS(scene.with(thickness(64), 60, options), NeedsMemory);
}

TEST_CASE("rules by shape are the same for any tiles, threads and memory", "[quick][measure]") {
  const ShapeRule rule = GENERATE(thickness(2), gap(7), gap(9, ScaleMode::increase));
  reference::Random random(GENERATE(1u, 3u));
  const Scene scene(reference::random_solid(random, {{-70, 3, 5}, {100, 60, 70}}));
  std::vector<ScaleField> fields;
  for (const std::int32_t tile : {0, 64, 192}) {
    for (const int threads : {1, 3}) {
      const ThreadLimit limit(threads);
      MeasureOptions options;
      options.tile_vox = tile;
      options.context.memory.bytes = std::uint64_t(threads) << 27;
      fields.push_back(scene.with(rule, 7, options));
    }
  }
  bool same = true;
  for (const ScaleField& f : fields) same = same && f == fields[0];
  CHECK(same);
}
