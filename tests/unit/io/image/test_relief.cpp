#include <cmath>
#include <random>

#include "io/image/relief.h"
#include "tests/catch.h"

using namespace bp;

namespace {

TextureImage heights(int width, int height) {
  TextureImage image(width, height);
  std::minstd_rand random(7);
  for (TextureImage::Texel& t : image.texels) {
    const auto h = std::uint8_t(random() % 256);
    t = {h, h, h, 90};
  }
  return image;
}

/// As written down in the header, with another image for the result.
TextureImage plain_directions(const TextureImage& from, const Relief& relief) {
  TextureImage to = from;
  const auto at = [&](int x, int y) {
    const int w = from.width, h = from.height;
    if (relief.repeats) return double(from.at((x + w) % w, (y + h) % h)[1]);
    return double(from.at(std::min(std::max(x, 0), w - 1), std::min(std::max(y, 0), h - 1))[1]);
  };
  const auto apart = [&](int i, int count) {
    return relief.repeats ? 2 : std::max(1, std::min(i + 1, count - 1) - std::max(i - 1, 0));
  };
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      const double u = relief.strength * (at(x + 1, y) - at(x - 1, y)) / 255 / apart(x, from.width);
      const double v = relief.strength * (at(x, y + 1) - at(x, y - 1)) / 255 / apart(y, from.height);
      const double l = std::sqrt(u * u + v * v + 1);
      const auto byte = [l](double part) { return std::uint8_t(std::floor((part / l + 1) * 127.5 + 0.5)); };
      to.at(x, y) = {byte(-u), byte(v), byte(1), 255};
    }
  }
  return to;
}

}  // namespace

TEST_CASE("heights become the slopes between the neighbours of each texel", "[quick][io]") {
  const Relief relief{GENERATE(1.0, 6.5, -2.0), GENERATE(false, true)};
  for (const auto& [width, height] :
       {std::pair{9, 6}, std::pair{1, 5}, std::pair{5, 1}, std::pair{2, 2}, std::pair{1, 1}}) {
    CAPTURE(relief.strength, relief.repeats, width, height);
    TextureImage image = heights(width, height);
    const TextureImage expected = plain_directions(image, relief);
    turn_into_directions(image, relief);
    CHECK(image.texels == expected.texels);
  }
  TextureImage nothing;
  turn_into_directions(nothing, relief);
  CHECK(nothing.texels.empty());
}

TEST_CASE("a gentle relief has its strength before it is rounded to bytes", "[quick][io]") {
  TextureImage ramp(16, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 16; ++x) ramp.at(x, y) = {std::uint8_t(x / 2), std::uint8_t(x / 2), std::uint8_t(x / 2), 255};
  turn_into_directions(ramp, {80, false});  // half a grey value a texel: 0.16
  const double slope = 80 * 0.5 / 255, lean = slope / std::sqrt(1 + slope * slope);
  for (int x = 1; x < 15; ++x) CHECK(std::abs(ramp.at(x, 2)[0] / 127.5 - 1 + lean) < 0.005);
}

TEST_CASE("directions lean by their strength more, and keep their alpha", "[quick][io]") {
  TextureImage image(2, 1, {128, 128, 255, 7});
  const double slope = 0.3, l = std::sqrt(1 + slope * slope);
  image.at(1, 0) = {std::uint8_t(std::lround((slope / l + 1) * 127.5)), 128,
                    std::uint8_t(std::lround((1 / l + 1) * 127.5)), 9};
  strengthen(image, 2);
  CHECK(image.at(0, 0)[3] == 7);
  CHECK(std::abs(int(image.at(0, 0)[0]) - 128) <= 1);
  const double x = image.at(1, 0)[0] / 127.5 - 1, z = image.at(1, 0)[2] / 127.5 - 1;
  CHECK(x / z == Approx(2 * slope).margin(0.02));
  CHECK(image.at(1, 0)[3] == 9);
}
