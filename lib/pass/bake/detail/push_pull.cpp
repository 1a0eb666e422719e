#include "lib/pass/bake/detail/push_pull.h"

#include <algorithm>
#include <array>

namespace bp {

namespace {

/// Channels of a texel.
struct Channels {
  std::size_t begin, end;
};

/// Gives texels next to known ones the mean of those, and makes them known.
void grow(TextureImage& image, std::vector<std::uint8_t>& known, Channels c) {
  constexpr std::uint8_t kNew = 2;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t& here = known[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
      if (here != 0) continue;
      std::array<int, 4> sum{};
      int count = 0;
      for (int j = std::max(0, y - 1); j <= std::min(y + 1, image.height - 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(x + 1, image.width - 1); ++i) {
          if (known[std::size_t(j) * std::size_t(image.width) + std::size_t(i)] != 1) continue;
          for (std::size_t k = c.begin; k < c.end; ++k) sum[k] += image.at(i, j)[k];
          ++count;
        }
      }
      if (count == 0) continue;
      here = kNew;
      for (std::size_t k = c.begin; k < c.end; ++k) image.at(x, y)[k] = std::uint8_t((sum[k] + count / 2) / count);
    }
  }
}

/// Returns a copy half as large. A texel is known if one of its four texels is.
TextureImage halved(const TextureImage& image, const std::vector<std::uint8_t>& known, Channels c,
                    std::vector<std::uint8_t>& half_known) {
  TextureImage half((image.width + 1) / 2, (image.height + 1) / 2);
  half_known.assign(half.texels.size(), 0);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      std::array<int, 4> sum{};
      int count = 0;
      for (int j = 2 * y; j < std::min(2 * y + 2, image.height); ++j) {
        for (int i = 2 * x; i < std::min(2 * x + 2, image.width); ++i) {
          if (known[std::size_t(j) * std::size_t(image.width) + std::size_t(i)] == 0) continue;
          for (std::size_t k = c.begin; k < c.end; ++k) sum[k] += image.at(i, j)[k];
          ++count;
        }
      }
      if (count == 0) continue;
      half_known[std::size_t(y) * std::size_t(half.width) + std::size_t(x)] = 1;
      for (std::size_t k = c.begin; k < c.end; ++k) half.at(x, y)[k] = std::uint8_t((sum[k] + count / 2) / count);
    }
  }
  return half;
}

/// Fills texels from copies half, a quarter ... as large.
void push_pull(TextureImage& image, const std::vector<std::uint8_t>& known, Channels c) {
  if (image.width <= 1 && image.height <= 1) return;
  if (std::find(known.begin(), known.end(), 0) == known.end()) return;
  std::vector<std::uint8_t> half_known;
  TextureImage half = halved(image, known, c, half_known);
  push_pull(half, half_known, c);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (known[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] != 0) continue;
      for (std::size_t k = c.begin; k < c.end; ++k) image.at(x, y)[k] = half.at(x / 2, y / 2)[k];
    }
  }
}

void fill(TextureImage& image, std::vector<std::uint8_t> known, Channels c) {
  grow(image, known, c);
  push_pull(image, known, c);
}

/// Returns a mask: 1 for texels that f(texel) takes, else 0.
template <class F>
std::vector<std::uint8_t> those(const std::vector<BakedTexel>& texels, const F& f) {
  std::vector<std::uint8_t> known(texels.size());
  std::transform(texels.begin(), texels.end(), known.begin(), [&](BakedTexel t) { return f(t) ? 1 : 0; });
  return known;
}

}  // namespace

void fill_gaps(TextureImage& image, const std::vector<BakedTexel>& texels) {
  fill(image, those(texels, [](BakedTexel t) { return t == BakedTexel::color; }), {0, 3});
}

void fill_alpha(TextureImage& image, const std::vector<BakedTexel>& texels) {
  if (std::find(texels.begin(), texels.end(), BakedTexel::hole) == texels.end()) return;
  fill(image, those(texels, [](BakedTexel t) { return t != BakedTexel::gap; }), {3, 4});
}

}  // namespace bp
