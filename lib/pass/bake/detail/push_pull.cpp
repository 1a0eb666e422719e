#include "lib/pass/bake/detail/push_pull.h"

#include <algorithm>
#include <array>

namespace bp {

namespace {

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

}  // namespace

void fill_gaps(TextureImage& image, const std::vector<std::uint8_t>& known) {
  if (image.width <= 1 && image.height <= 1) return;
  if (std::find(known.begin(), known.end(), 0) == known.end()) return;
  std::vector<std::uint8_t> half_known;
  TextureImage half = halved(image, known, half_known);
  fill_gaps(half, half_known);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (known[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] != 0) continue;
      for (std::size_t k = 0; k < 3; ++k) image.at(x, y)[k] = half.at(x / 2, y / 2)[k];
    }
  }
}

}  // namespace bp
