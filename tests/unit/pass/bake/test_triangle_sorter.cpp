#include "lib/pass/bake/detail/triangle_sorter.h"
#include "lib/store/memory_scratch.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("triangles come sorted in the same groups for any memory, each once", "[quick][bake]") {
  RandomLattice random(3);
  std::vector<TexturedTriangle> all;
  Bounds3d bounds;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const LatticeCoord c = random.point(-100, 100);
    const double size = i % 100 == 0 ? 100 : 1;
    TexturedTriangle t;
    const Vec3d p{double(c.x), double(c.y), double(c.z)};
    t.corners = {p, {p[0] + size, p[1], p[2]}, {p[0], p[1] + size, p[2]}};
    t.texture.material = i;
    for (const Vec3d& q : t.corners) bounds.add(q);
    all.push_back(t);
  }
  const auto sorted = [&](std::uint64_t memory_bytes) {
    MemoryScratch store;
    TriangleSorter sorter(bounds, store, memory_bytes);
    for (const TexturedTriangle& t : all) sorter.add(t);
    std::vector<std::vector<std::uint32_t>> groups;
    sorter.finish(500, [&](std::span<const TexturedTriangle> group) {
      groups.emplace_back();
      for (const TexturedTriangle& t : group) groups.back().push_back(t.texture.material);
    });
    return groups;
  };
  const auto plenty = sorted(1 << 30);
  CHECK(sorted(1) == plenty);  // five runs
  std::vector<bool> met(all.size());
  double diagonals = 0;
  for (const auto& group : plenty) {
    CHECK(group.size() <= 500);
    Bounds3d box;
    for (const std::uint32_t i : group) {
      CHECK_FALSE(met[i]);
      met[i] = true;
      CHECK((i % 100 == 0) == (group[0] % 100 == 0));
      for (const Vec3d& p : all[i].corners) box.add(p);
    }
    diagonals += box.diagonal();
  }
  CHECK(diagonals < 0.5 * double(plenty.size()) * bounds.diagonal());  // not far from each other
  CHECK(std::count(met.begin(), met.end(), true) == 20000);
}
