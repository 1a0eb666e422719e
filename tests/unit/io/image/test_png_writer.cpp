#include <png.h>

#include "io/image/png_writer.h"
#include "lib/core/error.h"
#include "tests/catch.h"

using namespace bp;

namespace {

Image decode(const std::vector<std::byte>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) != 0);
  CHECK(png.format == PNG_FORMAT_RGB);  // as it is in the file
  Image image(int(png.width), int(png.height), {});
  REQUIRE(png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) != 0);
  return image;
}

}  // namespace

TEST_CASE("a PNG reads back as the picture that was written", "[quick][io]") {
  Image image(37, 19, {1, 2, 3});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = {std::uint8_t(x * 7 + y), std::uint8_t(x ^ y), std::uint8_t(y * 13)};
  const Image back = decode(encode_png(image));
  CHECK(back.width == 37);
  CHECK(back.height == 19);
  CHECK(back.pixels == image.pixels);
  CHECK(encode_png(image) == encode_png(image));
}

TEST_CASE("a picture whose name says another format is refused", "[quick][io]") {
  for (const char* name : {"", "a.png", "b/c.d.PNG"}) CHECK_NOTHROW(check_png_name(name));
  for (const char* name : {"a.jpg", "png", "a.png.glb", "-", ".pn"}) CHECK_THROWS_AS(check_png_name(name), Error);
}

TEST_CASE("an image without pixels is refused", "[quick][io]") {
  CHECK_THROWS_AS(encode_png(Image{}), Error);
}
