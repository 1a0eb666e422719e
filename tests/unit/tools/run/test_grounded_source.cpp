#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tools/run/grounded_source.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a grounded scene ends with the rectangle below it", "[quick][tools]") {
  Triangles scene;
  add_box(scene, {1, 2, 3}, {4, 6, 8});
  using Up = std::optional<UpAxis>;
  const auto [up, below] = GENERATE(table<Up, Bounds3d>({{{}, {{1, 2, 3}, {4, 2, 8}}},
                                                         {UpAxis::z, {{1, 2, 3}, {4, 6, 3}}},
                                                         {UpAxis::x, {{1, 2, 3}, {1, 6, 8}}},
                                                         {UpAxis::minus_x, {{4, 2, 3}, {4, 6, 8}}},
                                                         {UpAxis::minus_y, {{1, 6, 3}, {4, 6, 8}}},
                                                         {UpAxis::minus_z, {{1, 2, 8}, {4, 6, 8}}}}));
  GroundedSource source(std::make_unique<MemorySource>(scene, 5), up);
  for (int pass = 0; pass < 2; ++pass) {
    Triangles all, chunk;
    while (source.read(chunk)) all.insert(all.end(), chunk.begin(), chunk.end());
    REQUIRE(all.size() == scene.size() + 2);
    CHECK(std::equal(scene.begin(), scene.end(), all.begin()));
    Bounds3d ground;
    for (std::size_t i = scene.size(); i < all.size(); ++i)
      for (const Vec3d& p : all[i]) ground.add(p);
    CHECK(ground == below);
    source.rewind();
  }
  GroundedSource empty(std::make_unique<MemorySource>(Triangles{}), up);
  Triangles chunk;
  CHECK_FALSE(empty.read(chunk));
}
