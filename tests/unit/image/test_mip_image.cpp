#include <cmath>
#include <limits>

#include "lib/core/color.h"
#include "lib/image/image_cache.h"
#include "tests/catch.h"
#include "tests/support/textured_scene.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr std::array<TextureWrap, 2> kRepeat{}, kClamp{TextureWrap::clamp, TextureWrap::clamp},
    kMirror{TextureWrap::mirror, TextureWrap::mirror};

/// Red rises with x, green with y.
TextureImage ramp(int width, int height) {
  TextureImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {std::uint8_t(255 * x / width), std::uint8_t(255 * y / height), 77, 255};
  return image;
}

}  // namespace

TEST_CASE("bytes of linear light are the nearest in sRGB", "[quick][bake]") {
  for (int i = 0; i < 256; ++i) CHECK(int(byte_of_linear(linear_of_byte(std::uint8_t(i)))) == i);
  for (int i = 0; i <= 65535; i += 7) {
    const auto exact = srgb_bytes({std::uint16_t(i), 0, 0})[0];
    CHECK(std::abs(int(byte_of_linear(float(i) / 65535)) - int(exact)) <= 1);
  }
  CHECK(byte_of_linear(std::numeric_limits<float>::quiet_NaN()) == 0);
  CHECK(byte_of_linear(7) == 255);
}

TEST_CASE("a look at the middle of a texel is that texel", "[quick][bake]") {
  const TextureImage image = ramp(7, 5);
  const MipImage mips(image);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const LinearTexel t = mips.at((x + 0.5) / 7, (y + 0.5) / 5, 1, kRepeat);
      for (std::size_t i = 0; i < 3; ++i) CHECK(int(byte_of_linear(t[i])) == int(image.at(x, y)[i]));
      const LinearTexel again = mips.at((x + 0.5) / 7 + 3, (y + 0.5) / 5 - 8, 0.1, kRepeat);
      for (std::size_t i = 0; i < 4; ++i) CHECK(again[i] == Approx(t[i]).margin(1e-6));
    }
  }
}

TEST_CASE("images repeat, are mirrored or end", "[quick][bake]") {
  const MipImage mips(ramp(8, 8));
  CHECK(mips.at(1.25, 0.5, 1, kMirror) == mips.at(0.75, 0.5, 1, kMirror));
  CHECK(mips.at(-0.25, 0.5, 1, kMirror) == mips.at(0.25, 0.5, 1, kMirror));
  CHECK(mips.at(5, 0.5, 1, kClamp) == mips.at(1, 0.5, 1, kClamp));
  CHECK(mips.at(0, 0.5, 1, kClamp)[0] == linear_of_byte(0));
  // Over the edge of an image that repeats lies its other side.
  CHECK(mips.at(0, 0.0625, 1, kRepeat)[0] == Approx((linear_of_byte(0) + linear_of_byte(223)) / 2));
}

TEST_CASE("a look at everything is the mean in linear light", "[quick][bake]") {
  TextureImage image(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      image.at(x, y) = (x + y) % 2 == 0 ? TextureImage::Texel{255, 255, 255, 255} : TextureImage::Texel{0, 0, 0, 255};
  const LinearTexel t = MipImage(image).at(0.3, 0.7, 64, kRepeat);
  CHECK(t[0] == Approx(0.5).margin(0.01));
  CHECK(int(byte_of_linear(t[0])) == 188);
}

TEST_CASE("what is transparent gives no colour", "[quick][bake]") {
  TextureImage image(2, 1);
  image.at(0, 0) = {255, 0, 0, 255};
  image.at(1, 0) = {0, 255, 0, 0};
  const LinearTexel t = MipImage(image).at(0.5, 0.5, 2, kRepeat);
  CHECK(t[0] == Approx(1));
  CHECK(t[1] == Approx(0).margin(1e-6));
  CHECK(t[3] == Approx(0.5).margin(0.01));
}

TEST_CASE("places that are no numbers, or huge, are somewhere in the image", "[quick][bake]") {
  const MipImage mips(ramp(5, 3));
  for (const double x : {double(NAN), double(INFINITY), -double(INFINITY), 1e300, -1e300, 3.4e38, -1e-300}) {
    for (const auto& wrap : {kRepeat, kClamp, kMirror}) {
      for (const double texels : {0.0, 1.0, 1e9, double(NAN), double(INFINITY)}) {
        const LinearTexel t = mips.at(x, x, texels, wrap);
        CHECK(t[3] == 1);
        CHECK(t[0] >= 0);
        CHECK(t[0] <= 1);
      }
    }
  }
}

TEST_CASE("images beyond the memory are decoded again, broken ones are named once", "[quick][bake]") {
  auto textures = std::make_shared<MemoryTextures>();
  textures->images = {ramp(64, 64), ramp(64, 64), TextureImage()};
  MemoryShare memory;
  memory.bytes = 40000;  // one, with its smaller copies, takes 21844 bytes
  ImageCache cache(textures, memory);
  CHECK(cache.get(0) == cache.get(0));
  CHECK(textures->decoded == 1);
  (void)cache.get(1);
  (void)cache.get(0);
  CHECK(textures->decoded == 3);
  CHECK(cache.get(2) == nullptr);
  CHECK(cache.get(2) == nullptr);
  CHECK(textures->decoded == 4);
  CHECK(cache.faults() == std::vector<std::string>{"image 2: broken"});
  CHECK(cache.get(TextureMaterial::kNoImage) == nullptr);
  memory.bytes = 10000;
  ImageCache small(textures, memory);
  try {
    (void)small.get(0);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::out_of_resource);
  }
}

TEST_CASE("a scene without images has none", "[quick][bake]") {
  ImageCache cache(nullptr, MemoryShare{1000});
  CHECK(cache.get(TextureMaterial::kNoImage) == nullptr);
  CHECK(cache.faults().empty());
}
