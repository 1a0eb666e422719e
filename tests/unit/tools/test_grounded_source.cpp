#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tools/common/grounded_source.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a grounded scene ends with the rectangle below it", "[quick][tools]") {
  Triangles scene;
  add_box(scene, {1, 2, 3}, {4, 6, 8});
  const auto up = GENERATE(std::optional<UpAxis>(), std::optional<UpAxis>(UpAxis::z));
  GroundedSource source(std::make_unique<MemorySource>(scene, 5), up);
  for (int pass = 0; pass < 2; ++pass) {
    Triangles all, chunk;
    while (source.read(chunk)) all.insert(all.end(), chunk.begin(), chunk.end());
    REQUIRE(all.size() == scene.size() + 2);
    CHECK(std::equal(scene.begin(), scene.end(), all.begin()));
    Bounds3d ground;
    for (std::size_t i = scene.size(); i < all.size(); ++i)
      for (const Vec3d& p : all[i]) ground.add(p);
    const Bounds3d below = up ? Bounds3d{{1, 2, 3}, {4, 6, 3}} : Bounds3d{{1, 2, 3}, {4, 2, 8}};
    CHECK(ground == below);
    source.rewind();
  }
  GroundedSource empty(std::make_unique<MemorySource>(Triangles{}), up);
  Triangles chunk;
  CHECK_FALSE(empty.read(chunk));
}
