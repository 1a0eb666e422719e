#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"
#include "tools/check/check_budget.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("bpcheck counts the largest document of its scenes, beside what is in memory then", "[quick][tools]") {
  constexpr std::uint64_t kMemory = std::uint64_t(1) << 30;
  const auto left = [](std::size_t scenes, const std::vector<IndexedMesh>& proxy) {
    CheckBudget budget(kMemory, scenes);
    budget.take(proxy);
    return budget.of_scene_document().bytes;
  };
  IndexedMesh mesh;
  mesh.triangles.resize(1'000'000);  // 400 MB with all that is found out about them
  const std::uint64_t all = CheckBudget(kMemory, 0).of_proxy().document.bytes;
  CHECK(left(1, {}) == all);
  CHECK(left(1, {mesh}) + 400'000'000 == all);
  CHECK(left(2, {}) == all / 3);  // triangles of the first are kept
  CHECK(left(5, {}) == all / 3);  // documents of the others have gone
  mesh.triangles.resize(10'000'000);
  CHECK(left(1, {mesh}) > 0);  // 0 would be no limit
}

TEST_CASE("the memory that bpcheck names suffices for the document", "[quick][tools]") {
  constexpr std::uint64_t kMemory = std::uint64_t(512) << 20, kDocument = std::uint64_t(900) << 20;
  for (const std::size_t scenes : {1, 2, 3}) {
    const MemoryShare small = CheckBudget(kMemory, scenes).of_scene_document();
    const std::uint64_t named = small.limit_with(kDocument - small.bytes);
    CAPTURE(scenes, named);
    const std::uint64_t enough = CheckBudget(named, scenes).of_scene_document().bytes;
    CHECK(enough >= kDocument);
    CHECK(enough < kDocument + (std::uint64_t(4) << 20));
  }
}
