#include "lib/pass/close/same_scales.h"
#include "tests/catch.h"
#include "tests/unit/grid/random_fields.h"

using namespace bp;

TEST_CASE("two fields have the same scales in a box exactly where their samples are the same", "[quick][pass]") {
  GridFrame frame;
  frame.voxel = 0.25;
  int same = 0, others = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const ScaleField a = test::random_field(seed);
    ScaleField b = a;
    test::Random random(seed);
    if (seed % 3 == 0) b.rules.erase(b.rules.begin() + std::ptrdiff_t(random() % b.rules.size()));
    if (seed % 3 == 1)
      b.rules.push_back(stroke_rule(ScaleMode::decrease, test::random_point(random, 20), 12, 0.1, b.base));
    if (seed % 3 == 2) b.rules[random() % b.rules.size()].radius += 1;
    for (int i = 0; i < 20; ++i) {
      const VoxelCoord p{int(random() % 240) - 160, int(random() % 240) - 120, int(random() % 240) - 140};
      const VoxelBox box{p, p + VoxelCoord{1 + int(random() % 150), 1 + int(random() % 40), 1 + int(random() % 90)}};
      const bool expected = a.sample(frame, box).samples == b.sample(frame, box).samples;
      CHECK(same_scales(a, b, frame, box) == expected);
      ++(expected ? same : others);
    }
  }
  CHECK(same > 100);
  CHECK(others > 30);
}
