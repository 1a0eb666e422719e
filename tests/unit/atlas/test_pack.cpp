#include "lib/atlas/pack.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("packed rectangles lie in the strip, and none over another", "[quick][atlas]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    RandomLattice random(seed);
    std::vector<PackedRect> rects(std::size_t(random.between(1, 120)));
    for (PackedRect& r : rects) r = {int(random.between(1, 20)), int(random.between(1, seed % 2 == 0 ? 20 : 90))};
    const int width = int(random.between(20, 120));
    const std::vector<PackedRect> asked = rects;
    const std::optional<int> height = pack(rects, width, 100000);
    REQUIRE(height);
    std::vector<int> covered(std::size_t(width) * std::size_t(*height));
    int highest = 0;
    for (std::size_t i = 0; i < rects.size(); ++i) {
      const PackedRect& r = rects[i];
      CHECK(r.width == asked[i].width);
      CHECK(r.height == asked[i].height);
      REQUIRE(r.x >= 0);
      REQUIRE(r.x + r.width <= width);
      REQUIRE(r.y >= 0);
      REQUIRE(r.y + r.height <= *height);
      highest = std::max(highest, r.y + r.height);
      for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x) ++covered[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
    CHECK(highest == *height);
    CHECK(std::count_if(covered.begin(), covered.end(), [](int n) { return n > 1; }) == 0);
  }
}

TEST_CASE("rectangles that do not fit are not packed", "[quick][atlas]") {
  std::vector<PackedRect> wide{{11, 1}}, high{{5, 6}, {6, 6}};
  CHECK_FALSE(pack(wide, 10, 100));
  CHECK_FALSE(pack(high, 10, 11));
  CHECK(pack(high, 10, 12) == 12);
  CHECK(pack(high, 11, 6) == 6);
}
