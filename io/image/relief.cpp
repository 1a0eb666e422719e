#include "io/image/relief.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace bp {

bool is_grey(const TextureImage& image) {
  constexpr int kSame = 8;  // of 255
  return std::all_of(image.texels.begin(), image.texels.end(), [](const TextureImage::Texel& t) {
    return std::abs(int(t[0]) - int(t[1])) <= kSame && std::abs(int(t[1]) - int(t[2])) <= kSame;
  });
}

TextureImage directions_of(const TextureImage& heights) {
  TextureImage out(heights.width, heights.height);
  const auto byte = [](double x) { return std::uint8_t((x / 2 + 0.5) * 255 + 0.5); };
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int left = std::max(0, x - 1), right = std::min(out.width - 1, x + 1);
      const int above = std::max(0, y - 1), below = std::min(out.height - 1, y + 1);
      const auto rise = [&](const TextureImage::Texel& from, const TextureImage::Texel& to, int texels) {
        return texels == 0 ? 0 : (double(to[1]) - from[1]) / (255 * texels);
      };
      const double along_u = rise(heights.at(left, y), heights.at(right, y), right - left),
                   down = rise(heights.at(x, above), heights.at(x, below), below - above);
      const double l = std::sqrt(along_u * along_u + down * down + 1);
      out.at(x, y) = {byte(-along_u / l), byte(down / l), byte(1 / l), 255};
    }
  }
  return out;
}

}  // namespace bp
