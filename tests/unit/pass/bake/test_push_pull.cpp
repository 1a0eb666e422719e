#include "lib/pass/bake/detail/push_pull.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("gaps take the colours beside them, and colours stay", "[quick][bake]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomLattice random(seed);
    TextureImage image(int(random.between(1, 40)), int(random.between(1, 40)));
    std::vector<BakedTexel> known(image.texels.size());
    int least = 255, most = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
      image.texels[i][3] = std::uint8_t(i);
      if (i > 0 && random.between(0, 9) > 0) continue;
      known[i] = BakedTexel::color;
      image.texels[i] = {std::uint8_t(random.between(20, 220)), 100, 0, std::uint8_t(i)};
      least = std::min(least, int(image.texels[i][0]));
      most = std::max(most, int(image.texels[i][0]));
    }
    const TextureImage before = image;
    fill_gaps(image, known);
    fill_alpha(image, known);  // there is no hole
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i] == BakedTexel::color) CHECK(image.texels[i] == before.texels[i]);
      CHECK(int(image.texels[i][0]) >= least);
      CHECK(int(image.texels[i][0]) <= most);
      CHECK(int(image.texels[i][1]) == 100);
      CHECK(image.texels[i][3] == before.texels[i][3]);
    }
  }
}

TEST_CASE("a texel beside a colour has that colour", "[quick][bake]") {
  TextureImage image(8, 8);
  std::vector<BakedTexel> known(64);
  image.texels[0] = {255, 0, 0, 255};
  image.texels[63] = {0, 0, 255, 255};
  known[0] = known[63] = BakedTexel::color;
  fill_gaps(image, known);
  CHECK(image.texels[1] == TextureImage::Texel{255, 0, 0, 0});
  CHECK(image.texels[62] == TextureImage::Texel{0, 0, 255, 0});
}

TEST_CASE("a texel beside a colour has that colour, wherever squares of texels begin", "[quick][bake]") {
  for (int dark = 1; dark < 14; ++dark) {
    TextureImage image(16, 16);
    std::vector<BakedTexel> known(image.texels.size());
    for (int y = 0; y < 16; ++y) {
      for (int x = dark; x < 16; ++x) {
        image.at(x, y) = x < dark + 2 ? TextureImage::Texel{20, 20, 20, 255} : TextureImage::Texel{220, 180, 160, 255};
        known[std::size_t(16 * y + x)] = BakedTexel::color;
      }
    }
    fill_gaps(image, known);
    CAPTURE(dark);
    CHECK(image.at(dark - 1, 7) == TextureImage::Texel{20, 20, 20, 0});
  }
}

TEST_CASE("a texel beside a hole is a hole, and holes have the colour beside them", "[quick][bake]") {
  TextureImage image(8, 8, {0, 0, 0, 255});
  std::vector<BakedTexel> known(64);
  image.texels[0] = {90, 60, 30, 255};
  known[0] = BakedTexel::color;
  image.texels[63] = {0, 0, 0, 0};
  known[63] = BakedTexel::hole;
  fill_gaps(image, known);
  fill_alpha(image, known);
  CHECK(image.texels[1] == TextureImage::Texel{90, 60, 30, 255});
  CHECK(image.texels[62] == TextureImage::Texel{90, 60, 30, 0});
  CHECK(image.texels[63] == TextureImage::Texel{90, 60, 30, 0});
}
