#include <webp/encode.h>

#include "io/image/image_reader.h"
#include "io/image/texture_writer.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr std::uint64_t kPlenty = std::uint64_t(1) << 30;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TextureImage smooth(int width, int height, std::uint8_t alpha) {
  TextureImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {std::uint8_t(255 * x / width), std::uint8_t(255 * y / height), 80, alpha};
  return image;
}

std::string webp_of(const TextureImage& image) {
  std::uint8_t* out = nullptr;
  const std::size_t n =
      WebPEncodeLosslessRGBA(image.texels.front().data(), image.width, image.height, image.width * 4, &out);
  std::string bytes(reinterpret_cast<const char*>(out), n);
  WebPFree(out);
  return bytes;
}

/// TGA of 24 or 32 bits, rows from the top; `packed`: as runs of one texel.
std::string tga_of(const TextureImage& image, bool alpha, bool packed) {
  std::string out(18, '\0');
  out[2] = packed ? 10 : 2;
  for (std::size_t k = 0; k < 2; ++k) {
    out[12 + k] = char(image.width >> (8 * k));
    out[14 + k] = char(image.height >> (8 * k));
  }
  out[16] = alpha ? 32 : 24;
  out[17] = alpha ? 0x28 : 0x20;
  for (const TextureImage::Texel& t : image.texels) {
    if (packed) out += '\0';
    for (const std::size_t k : {2, 1, 0}) out += char(t[k]);
    if (alpha) out += char(t[3]);
  }
  return out;
}

ErrorCode refusal(const std::string& bytes, std::uint64_t most = kPlenty) {
  try {
    (void)decode_image(bytes_of(bytes), "some.png", most);
  } catch (const Error& e) {
    CHECK_THAT(e.what(), Contains("some.png"));
    return e.code();
  }
  return ErrorCode::failed;
}

}  // namespace

TEST_CASE("textures are JPEG where they are opaque, else PNG, and are read back", "[quick][io]") {
  for (const auto& [width, height] : {std::pair{64, 48}, {1, 1}, {37, 5}}) {
    const TextureImage opaque = smooth(width, height, 255), clear = smooth(width, height, 120);
    const EncodedImage jpeg = encode_texture(opaque), png = encode_texture(clear);
    CHECK(jpeg.type == "image/jpeg");
    CHECK(png.type == "image/png");
    CHECK(encode_texture(opaque).bytes == jpeg.bytes);
    CHECK(decode_image(bytes_of(png.bytes), "x", kPlenty).texels == clear.texels);
    const TextureImage back = decode_image(bytes_of(jpeg.bytes), "x", kPlenty);
    REQUIRE(back.texels.size() == opaque.texels.size());
    for (std::size_t i = 0; i < back.texels.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(int(back.texels[i][k]) - int(opaque.texels[i][k])) <= 12);
      CHECK(int(back.texels[i][3]) == 255);
    }
    CHECK(image_size(bytes_of(jpeg.bytes), "x") == std::array{width, height});
    CHECK(image_size(bytes_of(png.bytes), "x") == std::array{width, height});
    const std::string webp = webp_of(clear);
    CHECK(decode_image(bytes_of(webp), "x", kPlenty).texels == clear.texels);
    CHECK(image_size(bytes_of(webp), "x") == std::array{width, height});
  }
}

TEST_CASE("TGA is read plain and packed; without alpha, or with none but 0, it is opaque", "[quick][io]") {
  const TextureImage opaque = smooth(37, 5, 255), clear = smooth(37, 5, 120);
  for (const std::string& file : {tga_of(opaque, false, false), tga_of(opaque, false, true),
                                  tga_of(opaque, true, false), tga_of(smooth(37, 5, 0), true, true)}) {
    CHECK(image_size(bytes_of(file), "x") == std::array{37, 5});
    CHECK(decode_image(bytes_of(file), "x", kPlenty).texels == opaque.texels);
    CHECK_FALSE(is_web_image(bytes_of(file), "x"));
    CHECK(refusal(file, 2 * 37 * 5 * 4 - 1) == ErrorCode::out_of_resource);
    for (const std::size_t cut : {std::size_t(9), file.size() / 2})
      CHECK(refusal(file.substr(0, file.size() - cut)) == ErrorCode::bad_input);
  }
  CHECK(decode_image(bytes_of(tga_of(clear, true, false)), "x", kPlenty).texels == clear.texels);
  std::string unused = tga_of(opaque, false, false);  // the size of a map of colours that it has not
  unused[5] = '\x7F';
  CHECK(decode_image(bytes_of(unused), "x", kPlenty).texels == opaque.texels);
  CHECK(is_web_image(bytes_of(encode_texture(clear).bytes), "x"));
}

TEST_CASE("images that are cut off, damaged or too large are refused", "[quick][io]") {
  const TextureImage image = smooth(64, 48, 120);
  RandomLattice random(1);
  for (const std::string& whole : {encode_texture(image).bytes, encode_texture(smooth(64, 48, 255)).bytes,
                                   webp_of(image), tga_of(image, true, true), tga_of(image, true, false)}) {
    CHECK(refusal(whole, 64 * 48 * 4 - 1) == ErrorCode::out_of_resource);
    for (const std::size_t n : {std::size_t(0), std::size_t(1), std::size_t(3), std::size_t(12), std::size_t(20)})
      CHECK(refusal(whole.substr(0, n)) == ErrorCode::bad_input);
    for (int i = 0; i < 300; ++i) {  // read, or refused; nothing else
      std::string bytes = whole;
      bytes[std::size_t(random.between(0, std::int64_t(bytes.size()) - 1))] = char(random.between(0, 255));
      try {
        (void)decode_image(bytes_of(bytes), "x", kPlenty);
      } catch (const Error& e) {
        CHECK((e.code() == ErrorCode::bad_input || e.code() == ErrorCode::out_of_resource));
      }
    }
  }
  CHECK(refusal("no image at all") == ErrorCode::bad_input);
  std::string huge = encode_texture(image).bytes;  // a PNG whose header promises 2^31 - 1 pixels a side
  for (const std::size_t at : {std::size_t(16), std::size_t(20)}) huge.replace(at, 4, "\x7F\xFF\xFF\xFF");
  CHECK(refusal(huge) == ErrorCode::bad_input);
}
