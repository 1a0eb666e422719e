#pragma once
#include <memory>
#include <vector>

#include "lib/core/texture.h"

namespace bp {

/// Red, green and blue in linear light, and alpha, from 0 to 1; not multiplied by alpha.
using LinearTexel = std::array<float, 4>;

/// An image and its smaller copies, each half as large. A mean over some of its texels is one look at a copy.
class MipImage {
 public:
  /// The meaning of the numbers: colours as sRGB with alpha, or plain numbers, whose alpha is ignored.
  enum class Kind : std::uint8_t { color, numbers };
  explicit MipImage(TextureImage image, Kind kind = Kind::color);

  [[nodiscard]] int width() const { return levels_.front().width; }
  [[nodiscard]] int height() const { return levels_.front().height; }
  [[nodiscard]] std::uint64_t bytes() const;
  /// Forgets the image and its copies that are wider or higher than `side`, but for the smallest.
  void keep_up_to(int side);
  /// Returns the mean around (u, v), which may be any numbers, over about `texels` texels along each side.
  [[nodiscard]] LinearTexel at(double u, double v, double texels, const std::array<TextureWrap, 2>& wrap) const;

 private:
  [[nodiscard]] LinearTexel at_level(std::size_t level, double u, double v,
                                     const std::array<TextureWrap, 2>& wrap) const;
  std::vector<TextureImage> levels_;
  Kind kind_;
};

/// Returns the image with sides half as long, rounded down, at least 1: each texel is the mean of four, in linear light
/// and by how much they cover if they are colours.
[[nodiscard]] TextureImage halved(const TextureImage& image, MipImage::Kind kind);

/// Convert 8-bit sRGB to linear light, and back to the nearest.
[[nodiscard]] float linear_of_byte(std::uint8_t srgb);
[[nodiscard]] std::uint8_t byte_of_linear(float linear);

}  // namespace bp
