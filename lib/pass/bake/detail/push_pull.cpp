#include "lib/pass/bake/detail/push_pull.h"

#include <algorithm>
#include <array>

namespace bp {

namespace {

/// Texels beside known ones get the mean of those, and are known, too.
void grow(TextureImage& image, std::vector<std::uint8_t>& known) {
  constexpr std::uint8_t kNew = 2;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t& here = known[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
      if (here != 0) continue;
      std::array<int, 3> sum{};
      int count = 0;
      for (int j = std::max(0, y - 1); j <= std::min(y + 1, image.height - 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(x + 1, image.width - 1); ++i) {
          if (known[std::size_t(j) * std::size_t(image.width) + std::size_t(i)] != 1) continue;
          for (std::size_t k = 0; k < 3; ++k) sum[k] += image.at(i, j)[k];
          ++count;
        }
      }
      if (count == 0) continue;
      here = kNew;
      for (std::size_t k = 0; k < 3; ++k) image.at(x, y)[k] = std::uint8_t((sum[k] + count / 2) / count);
    }
  }
}

/// Half as large; known where one of four texels is.
TextureImage halved(const TextureImage& image, const std::vector<std::uint8_t>& known,
                    std::vector<std::uint8_t>& half_known) {
  TextureImage half((image.width + 1) / 2, (image.height + 1) / 2);
  half_known.assign(half.texels.size(), 0);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      std::array<int, 3> sum{};
      int count = 0;
      for (int j = 2 * y; j < std::min(2 * y + 2, image.height); ++j) {
        for (int i = 2 * x; i < std::min(2 * x + 2, image.width); ++i) {
          if (known[std::size_t(j) * std::size_t(image.width) + std::size_t(i)] == 0) continue;
          for (std::size_t k = 0; k < 3; ++k) sum[k] += image.at(i, j)[k];
          ++count;
        }
      }
      if (count == 0) continue;
      half_known[std::size_t(y) * std::size_t(half.width) + std::size_t(x)] = 1;
      for (std::size_t k = 0; k < 3; ++k) half.at(x, y)[k] = std::uint8_t((sum[k] + count / 2) / count);
    }
  }
  return half;
}

/// From copies half, a quarter ... as large.
void push_pull(TextureImage& image, const std::vector<std::uint8_t>& known) {
  if (image.width <= 1 && image.height <= 1) return;
  if (std::find(known.begin(), known.end(), 0) == known.end()) return;
  std::vector<std::uint8_t> half_known;
  TextureImage half = halved(image, known, half_known);
  push_pull(half, half_known);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (known[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] != 0) continue;
      for (std::size_t k = 0; k < 3; ++k) image.at(x, y)[k] = half.at(x / 2, y / 2)[k];
    }
  }
}

}  // namespace

void fill_gaps(TextureImage& image, std::vector<std::uint8_t> known) {
  grow(image, known);
  push_pull(image, known);
}

}  // namespace bp
