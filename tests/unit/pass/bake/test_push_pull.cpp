#include "lib/pass/bake/detail/push_pull.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("gaps take the colours beside them, and colours stay", "[quick][bake]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomLattice random(seed);
    PartialImage image{int(random.between(1, 40)), int(random.between(1, 40)), {}, {}};
    const auto n = std::size_t(image.width) * std::size_t(image.height);
    image.texels.resize(n);
    image.weight.resize(n);
    float least = 1, most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0 && random.between(0, 9) > 0) continue;
      image.texels[i] = {float(random.between(10, 90)) / 100, 0.5F, 0, 1};
      image.weight[i] = float(random.between(1, 4));
      least = std::min(least, image.texels[i][0]);
      most = std::max(most, image.texels[i][0]);
    }
    const PartialImage before = image;
    fill_gaps(image);
    for (std::size_t i = 0; i < n; ++i) {
      if (before.weight[i] > 0) CHECK(image.texels[i] == before.texels[i]);
      CHECK(image.texels[i][0] >= least - 1e-6F);
      CHECK(image.texels[i][0] <= most + 1e-6F);
      CHECK(image.texels[i][1] == Approx(0.5));
    }
  }
}

TEST_CASE("a texel beside a colour has that colour", "[quick][bake]") {
  PartialImage image{8, 8, std::vector<LinearTexel>(64), std::vector<float>(64)};
  image.texels[0] = {1, 0, 0, 1};
  image.texels[63] = {0, 0, 1, 1};
  image.weight[0] = image.weight[63] = 1;
  fill_gaps(image);
  CHECK(image.texels[1] == LinearTexel{1, 0, 0, 1});
  CHECK(image.texels[62] == LinearTexel{0, 0, 1, 1});
}
