#include "lib/image/mip_image.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

/// Finds the nearest 8-bit values by thresholds between them, without pow() for a texel.
struct SrgbTables {
  std::array<float, 256> linear{};
  std::array<std::uint8_t, 4096> first{};  // the least byte of each interval of linear light
  SrgbTables() {
    const auto linear_of = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
    for (std::size_t i = 0; i < 256; ++i) linear[i] = float(linear_of(double(i) / 255));
    for (std::size_t i = 0; i < 255; ++i) above[i] = float(linear_of((double(i) + 0.5) / 255));
    above[255] = 2;
    std::size_t byte = 0;
    for (std::size_t k = 0; k < first.size(); ++k) {
      while (above[byte] < float(k) / float(first.size())) ++byte;
      first[k] = std::uint8_t(byte);
    }
  }
  [[nodiscard]] std::uint8_t byte_of(float x) const {
    if (!(x > 0)) return 0;
    if (x >= 1) return 255;
    std::uint8_t byte = first[std::size_t(x * float(first.size()))];
    while (above[byte] < x) ++byte;
    return byte;
  }

 private:
  std::array<float, 256> above{};  // the middle to the next byte
};

const SrgbTables& tables() {
  static const SrgbTables kTables;
  return kTables;
}

LinearTexel linear_of(const TextureImage::Texel& t, MipImage::Kind kind) {
  if (kind == MipImage::Kind::numbers) return {float(t[0]) / 255, float(t[1]) / 255, float(t[2]) / 255, 1};
  const auto& table = tables().linear;
  return {table[t[0]], table[t[1]], table[t[2]], float(t[3]) / 255};
}

/// A sum in which colours count as far as they cover.
struct Sum {
  LinearTexel sum{}, plain{};
  float weight = 0;
  void add(const LinearTexel& t, float w) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += w * t[3] * t[i], plain[i] += w * t[i];
    sum[3] += w * t[3];
    weight += w;
  }
  [[nodiscard]] LinearTexel mean() const {
    const LinearTexel& s = sum[3] > 0 ? sum : plain;
    const float by = sum[3] > 0 ? sum[3] : weight;
    return {s[0] / by, s[1] / by, s[2] / by, sum[3] / weight};
  }
};

TextureImage::Texel bytes_of(const LinearTexel& t, MipImage::Kind kind) {
  const auto plain = [](float x) { return std::uint8_t(x * 255 + 0.5F); };
  if (kind == MipImage::Kind::numbers) return {plain(t[0]), plain(t[1]), plain(t[2]), 255};
  return {byte_of_linear(t[0]), byte_of_linear(t[1]), byte_of_linear(t[2]), std::uint8_t(t[3] * 255 + 0.5F)};
}

double wrapped(double x, TextureWrap wrap) {
  if (!std::isfinite(x)) return 0;
  if (wrap == TextureWrap::clamp) return std::clamp(x, 0.0, 1.0);
  if (wrap == TextureWrap::repeat) return x - std::floor(x);
  const double two = x - 2 * std::floor(x / 2);
  return two > 1 ? 2 - two : two;
}

int wrapped(int i, int n, TextureWrap wrap) {
  if (wrap == TextureWrap::repeat) return i < 0 ? i + n : i >= n ? i - n : i;
  return std::clamp(i, 0, n - 1);
}

}  // namespace

TextureImage halved(const TextureImage& image, MipImage::Kind kind) {
  TextureImage half(std::max(1, image.width / 2), std::max(1, image.height / 2));
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      Sum sum;  // an odd last row or column is joined with the one before
      const int last_x = x + 1 == half.width ? image.width - 1 : 2 * x + 1;
      const int last_y = y + 1 == half.height ? image.height - 1 : 2 * y + 1;
      for (int j = 2 * y; j <= last_y; ++j) {
        for (int i = 2 * x; i <= last_x; ++i) sum.add(linear_of(image.at(i, j), kind), 1);
      }
      half.at(x, y) = bytes_of(sum.mean(), kind);
    }
  }
  return half;
}

float linear_of_byte(std::uint8_t srgb) {
  return tables().linear[srgb];
}

std::uint8_t byte_of_linear(float linear) {
  return tables().byte_of(linear);
}

MipImage::MipImage(TextureImage image, Kind kind) : kind_(kind) {
  levels_.push_back(std::move(image));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back(), kind_));
}

void MipImage::keep_up_to(int side) {
  const auto first = std::find_if(levels_.begin(), levels_.end() - 1, [side](const TextureImage& level) {
    return std::max(level.width, level.height) <= side;
  });
  levels_.erase(levels_.begin(), first);
}

std::uint64_t MipImage::bytes() const {
  std::uint64_t texels = 0;
  for (const TextureImage& level : levels_) texels += level.texels.size();
  return texels * sizeof(TextureImage::Texel);
}

LinearTexel MipImage::at_level(std::size_t n, double u, double v, const std::array<TextureWrap, 2>& wrap) const {
  const TextureImage& level = levels_[n];
  const double x = u * level.width - 0.5, y = v * level.height - 0.5;
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const auto fx = float(x - i), fy = float(y - j);
  Sum sum;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const float w = (dx == 0 ? 1 - fx : fx) * (dy == 0 ? 1 - fy : fy);
      sum.add(linear_of(level.at(wrapped(i + dx, level.width, wrap[0]), wrapped(j + dy, level.height, wrap[1])), kind_),
              w);
    }
  }
  return sum.mean();
}

LinearTexel MipImage::at(double u, double v, double texels, const std::array<TextureWrap, 2>& wrap) const {
  u = wrapped(u, wrap[0]);
  v = wrapped(v, wrap[1]);
  const double level = texels > 1 ? std::min(std::log2(texels), double(levels_.size() - 1)) : 0;
  const auto n = std::size_t(level);
  const auto part = float(level - double(n));
  const LinearTexel fine = at_level(n, u, v, wrap);
  if (part == 0 || n + 1 == levels_.size()) return fine;
  Sum sum;
  sum.add(fine, 1 - part);
  sum.add(at_level(n + 1, u, v, wrap), part);
  return sum.mean();
}

}  // namespace bp
