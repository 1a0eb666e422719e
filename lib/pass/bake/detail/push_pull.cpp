#include "lib/pass/bake/detail/push_pull.h"

#include <algorithm>

namespace bp {

namespace {

PartialImage halved(const PartialImage& image) {
  PartialImage half{(image.width + 1) / 2, (image.height + 1) / 2, {}, {}};
  half.texels.resize(std::size_t(half.width) * std::size_t(half.height));
  half.weight.resize(half.texels.size());
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      LinearTexel sum{};
      float weight = 0;
      for (int j = 2 * y; j < std::min(2 * y + 2, image.height); ++j) {
        for (int i = 2 * x; i < std::min(2 * x + 2, image.width); ++i) {
          const std::size_t from = std::size_t(j) * std::size_t(image.width) + std::size_t(i);
          if (image.weight[from] == 0) continue;
          for (std::size_t k = 0; k < 4; ++k) sum[k] += image.texels[from][k];
          weight += 1;
        }
      }
      const std::size_t to = std::size_t(y) * std::size_t(half.width) + std::size_t(x);
      half.weight[to] = weight;
      for (std::size_t k = 0; k < 4 && weight > 0; ++k) half.texels[to][k] = sum[k] / weight;
    }
  }
  return half;
}

}  // namespace

void fill_gaps(PartialImage& image) {
  if (image.width <= 1 && image.height <= 1) return;
  if (std::none_of(image.weight.begin(), image.weight.end(), [](float w) { return w == 0; })) return;
  PartialImage half = halved(image);
  fill_gaps(half);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t to = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
      if (image.weight[to] == 0)
        image.texels[to] = half.texels[std::size_t(y / 2) * std::size_t(half.width) + std::size_t(x / 2)];
    }
  }
}

}  // namespace bp
