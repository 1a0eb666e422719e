#pragma once
#include <cstdint>
#include <vector>

namespace bp {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Color&, const Color&) = default;
};

/// Pixels by rows from top to bottom, and from left to right.
struct Image {
  int width = 0, height = 0;
  std::vector<Color> pixels;

  Image() = default;
  Image(int w, int h, Color fill) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), fill) {}
  [[nodiscard]] Color& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  [[nodiscard]] const Color& at(int x, int y) const {
    return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }
};

}  // namespace bp
