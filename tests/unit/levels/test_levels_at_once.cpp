#include <algorithm>
#include <atomic>
#include <string_view>

#include "lib/check/check_proxy.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/levels/level_chain.h"
#include "lib/levels/lod_chain.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

LodOptions options_within(std::uint64_t bytes) {
  LodOptions options;
  options.context.make_shelf = memory_shelves();
  options.context.memory.bytes = bytes;
  options.context.pieces.waiting_bytes = options.context.pieces.work_bytes = bytes / 2;
  return options;
}

LodChain chain_of(const Triangles& scene, Backends& backends, LodOptions options) {
  Voxelized solid = voxelized(scene, 0.25);
  return {solid.header, std::move(solid.shelf), backends, std::move(options)};
}

std::vector<LodLevel> levels_of(const Triangles& scene, const std::vector<LodTarget>& targets, int threads,
                                LodOptions options) {
  const ThreadLimit limit(threads);
  Backends backends = plain_backends(2);
  return chain_of(scene, backends, std::move(options)).make(targets);
}

std::vector<LodLevel> levels_of(const Triangles& scene, const std::vector<LodTarget>& targets, int threads,
                                std::uint64_t bytes) {
  return levels_of(scene, targets, threads, options_within(bytes));
}

std::vector<LodLevel> one_by_one(const Triangles& scene, const std::vector<LodTarget>& targets, LodOptions options) {
  Backends backends = plain_backends(2);
  LodChain chain = chain_of(scene, backends, std::move(options));
  std::vector<LodLevel> levels;
  for (const LodTarget& target : targets) levels.push_back(chain.make(target));
  return levels;
}

void check_same(const std::vector<LodLevel>& a, const std::vector<LodLevel>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].mesh.vertices == b[i].mesh.vertices);
    CHECK(a[i].mesh.triangles == b[i].mesh.triangles);
    CHECK(a[i].error_world == b[i].error_world);
    CHECK(a[i].tried.size() == b[i].tried.size());
  }
}

constexpr std::uint64_t kPlenty = std::uint64_t(1) << 30;

}  // namespace

TEST_CASE("levels made at the same time do not depend on threads or memory", "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
  const std::vector<LodTarget> targets{{600, 0, {}}, {300, 0, {}}, {110, 0, {}}, {30, 0, {}}, {12, 0, {}}};
  const std::vector<LodLevel> alone = levels_of(scene, targets, 1, kPlenty);
  for (const LodLevel& level : alone) {
    MemorySource source(scene);
    CHECK(check_proxy(indexed(level.mesh), &source).holds());
  }
  check_same(alone, levels_of(scene, targets, 4, kPlenty));
  // As the memory shrinks, levels no longer suffice with their share, and are made one by one; at last none is.
  int made = 0, refused = 0;
  for (std::uint64_t bytes = std::uint64_t(64) << 20; bytes >= std::uint64_t(1) << 16; bytes /= 2) {
    try {
      check_same(alone, levels_of(scene, targets, 4, bytes));
      CHECK(refused == 0);
      ++made;
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::out_of_resource);
      ++refused;
    }
  }
  CHECK(made > 0);
  CHECK(refused > 0);
}

TEST_CASE("levels made at the same time, and one by one, are the same", "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
  const std::vector<LodTarget> targets{{600, 0, {}}, {110, 0, {}}, {30, 0, {}}};
  check_same(one_by_one(scene, targets, options_within(kPlenty)), levels_of(scene, targets, 2, kPlenty));
}

TEST_CASE("levels around triangles, fits, and levels by rules are the same at once and one by one",
          "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
  const std::vector<LodTarget> targets{{300, 0, {}}, {110, 0, {}}, {30, 0, {}}};
  LodOptions options = options_within(kPlenty);
  SECTION("around triangles") {
    options.enclose = Enclose::scene, options.scene = scene;
  }
  SECTION("fits") {
    options.mode = MeshMode::fit, options.scene = scene;
  }
  SECTION("by rules") {
    ScaleField field;
    field.base = 1;
    field.rules = {box_rule({-10, -10, -10}, {8, 20, 20}, 0.5)};
    options.field = ScalePlan{field, std::vector<RuleEntry>(1)};
  }
  check_same(one_by_one(scene, targets, options), levels_of(scene, targets, 4, options));
}

TEST_CASE("a level whose share of the memory does not suffice is made once more, alone", "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
  const std::vector<LodTarget> targets{{600, 0, {}}, {300, 0, {}}, {110, 0, {}}, {30, 0, {}}, {12, 0, {}}};
  const std::vector<LodLevel> plenty = levels_of(scene, targets, 4, kPlenty);
  int alone = 0;
  for (std::uint64_t bytes = std::uint64_t(16) << 20; alone == 0 && bytes >= std::uint64_t(1) << 16;
       bytes -= bytes / 8) {
    LodOptions options = options_within(bytes);
    bool at_once = false;
    options.context.progress = [&](const char*, const char* unit, std::uint64_t, std::uint64_t total) {
      if (std::string_view(unit) != "levels") return;
      if (total == targets.size())
        at_once = true;  // of levels that are made at the same time, only their number is told
      if (total == 1 && at_once) ++alone;
    };
    try {
      check_same(plenty, levels_of(scene, targets, 4, std::move(options)));
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::out_of_resource);
      break;  // less memory does not suffice either
    }
  }
  CHECK(alone > 0);
}

TEST_CASE("levels that are made at the same time stop when they are asked to", "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
  const std::vector<LodTarget> targets{{600, 0, {}}, {300, 0, {}}, {110, 0, {}}, {30, 0, {}}};
  std::atomic<bool> stop{false};
  LodOptions options = options_within(kPlenty);
  options.context.stop = &stop;
  std::uint64_t told = 0;
  options.context.progress = [&](const char*, const char*, std::uint64_t done, std::uint64_t total) {
    if (total != targets.size()) return;
    told = done;
    stop = true;  // the first level is there, and none of the others
  };
  CHECK_THROWS_AS(levels_of(scene, targets, 4, std::move(options)), Cancelled);
  CHECK(told == 1);
}

TEST_CASE("a sequence makes the first level alone only where the others follow from it", "[quick][pass][lod]") {
  const Triangles scene = turned_boxes();
  Backends backends = plain_backends(2);
  LodChain chain = chain_of(scene, backends, options_within(kPlenty));
  LevelRequest request;
  request.faces = {600};
  request.levels = 3;
  LevelSequence follow(chain, {request, 0, 3, 40});
  CHECK(follow.next() == std::vector<std::size_t>{0});
  follow.make_next();
  const std::vector<std::size_t> rest = follow.next();
  REQUIRE(rest == std::vector<std::size_t>{1, 2});
  follow.make_next();
  CHECK(follow.next().empty());
  const MadeLevels made = follow.take();
  REQUIRE(made.levels.size() == 3);
  const std::uint64_t first = made.levels[0].level.mesh.triangles.size();
  CHECK(made.levels[1].target.faces == (first < 570 ? first / 4 : 150));

  request.faces = {5000, 600, 110, 30};
  LevelSequence listed(chain, {request, 1, 3, 40});
  CHECK(listed.next() == std::vector<std::size_t>{1, 2, 3});
  listed.make_next();
  const MadeLevels all = listed.take();
  for (std::size_t i = 1; i < all.levels.size(); ++i) {
    CHECK(all.levels[i].level.error_world >= all.levels[i - 1].level.error_world);
    CHECK(all.levels[i].level.mesh.triangles.size() < all.levels[i - 1].level.mesh.triangles.size());
  }
}

}  // namespace bp::test
