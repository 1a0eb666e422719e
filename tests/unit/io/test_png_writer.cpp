#include <zlib.h>

#include <cstring>

#include "io/png_writer.h"
#include "lib/core/error.h"
#include "tests/catch.h"

using namespace bp;

namespace {

std::uint32_t u32(const std::byte* p) {
  std::uint32_t v = 0;
  for (int i = 0; i < 4; ++i) v = v << 8 | std::uint32_t(p[i]);
  return v;
}

/// Reads what encode_png() writes: chunks with their checksums, one filter.
Image decode(const std::vector<std::byte>& png) {
  Image image;
  std::vector<std::uint8_t> packed;
  REQUIRE(std::memcmp(png.data(), "\x89PNG\r\n\x1A\n", 8) == 0);
  for (std::size_t at = 8; at < png.size();) {
    const std::uint32_t size = u32(&png[at]);
    const std::string type(reinterpret_cast<const char*>(&png[at + 4]), 4);
    const auto* body = reinterpret_cast<const std::uint8_t*>(&png[at + 4]);
    CHECK(crc32(0, body, size + 4) == u32(&png[at + 8 + size]));
    if (type == "IHDR") image = Image(int(u32(&png[at + 8])), int(u32(&png[at + 12])), {});
    if (type == "IDAT") packed.assign(body + 4, body + 4 + size);
    at += 12 + size;
    if (at == png.size()) CHECK(type == "IEND");
  }
  const std::size_t row = 3 * std::size_t(image.width) + 1;
  std::vector<std::uint8_t> raw(row * std::size_t(image.height));
  uLongf n = raw.size();
  REQUIRE(uncompress(raw.data(), &n, packed.data(), packed.size()) == Z_OK);
  REQUIRE(n == raw.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = &raw[std::size_t(y) * row + 1 + 3 * std::size_t(x)];
      const Color above = y > 0 ? image.at(x, y - 1) : Color{};
      REQUIRE(raw[std::size_t(y) * row] == 2);
      image.at(x, y) = {std::uint8_t(p[0] + above.r), std::uint8_t(p[1] + above.g), std::uint8_t(p[2] + above.b)};
    }
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
