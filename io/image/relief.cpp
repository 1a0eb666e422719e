#include "io/image/relief.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace bp {

namespace {

TextureImage::Texel bytes_of(double x, double y, double z, std::uint8_t alpha) {
  const double l = std::sqrt(x * x + y * y + z * z);
  const auto byte = [l](double part) { return std::uint8_t((part / l / 2 + 0.5) * 255 + 0.5); };
  return l > 0 ? TextureImage::Texel{byte(x), byte(y), byte(z), alpha} : TextureImage::Texel{128, 128, 255, alpha};
}

std::vector<std::uint8_t> heights_of(const TextureImage& image, int y) {
  std::vector<std::uint8_t> row(std::size_t(image.width));
  for (int x = 0; x < image.width; ++x) row[std::size_t(x)] = image.at(x, y)[1];
  return row;
}

/// The two neighbours of texel `i` among `count`, and the distance between them.
struct Neighbours {
  int before, after, distance;
};

Neighbours neighbours(int i, int count, bool repeats) {
  if (repeats) return {(i + count - 1) % count, (i + 1) % count, 2};
  const int before = std::max(0, i - 1), after = std::min(count - 1, i + 1);
  return {before, after, std::max(1, after - before)};
}

}  // namespace

bool is_grey(const TextureImage& image) {
  constexpr int kSame = 8;  // largest difference between the channels of a grey texel, of 255
  return std::all_of(image.texels.begin(), image.texels.end(), [](const TextureImage::Texel& t) {
    return std::abs(int(t[0]) - int(t[1])) <= kSame && std::abs(int(t[1]) - int(t[2])) <= kSame;
  });
}

void turn_into_directions(TextureImage& image, const Relief& relief) {
  if (image.texels.empty()) return;
  const std::vector<std::uint8_t> first = heights_of(image, 0);
  std::vector<std::uint8_t> above = heights_of(image, neighbours(0, image.height, relief.repeats).before), here = first;
  for (int y = 0; y < image.height; ++y) {
    const Neighbours rows = neighbours(y, image.height, relief.repeats);
    std::vector<std::uint8_t> below = rows.after > y ? heights_of(image, rows.after) : rows.after == y ? here : first;
    for (int x = 0; x < image.width; ++x) {
      const Neighbours columns = neighbours(x, image.width, relief.repeats);
      const auto slope = [&](std::uint8_t from, std::uint8_t to, int distance) {
        return relief.strength * (int(to) - int(from)) / (255.0 * distance);
      };
      const double along_u =
                       slope(here[std::size_t(columns.before)], here[std::size_t(columns.after)], columns.distance),
                   down = slope(above[std::size_t(x)], below[std::size_t(x)], rows.distance);
      image.at(x, y) = bytes_of(-along_u, down, 1, 255);
    }
    above = std::move(here);
    here = std::move(below);
  }
}

void strengthen(TextureImage& directions, double strength) {
  for (TextureImage::Texel& t : directions.texels) {
    const auto part = [](std::uint8_t byte) { return byte / 127.5 - 1; };
    t = bytes_of(strength * part(t[0]), strength * part(t[1]), part(t[2]), t[3]);
  }
}

}  // namespace bp
