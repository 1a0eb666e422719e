#include "lib/image/mark.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bp {

namespace {

constexpr Color kArrow{214, 20, 70}, kRim{255, 255, 255};
constexpr int kRays = 4;  // samples of a pixel along each side
// Lengths as shares of a panel's side: of the arrow and its head; half widths of the shaft and of the head; the rim.
constexpr double kLength = 0.17, kHead = 0.05, kShaftHalf = 0.007, kHeadHalf = 0.021, kRimWidth = 0.004;
constexpr double kTextSize = 0.035;

using Point = std::array<double, 2>;

/// An arrow with its tip at the origin, along x to negative values.
struct Arrow {
  double side;
  /// Returns whether the arrow, grown by `rim`, holds a point.
  [[nodiscard]] bool holds(const Point& p, double rim) const {
    const double along = -p[0], across = std::abs(p[1]);
    const bool in_head =
        along >= -rim && along <= kHead * side + rim && across <= (along + rim) * (kHeadHalf / kHead) + rim;
    const bool in_shaft =
        along >= kHead * side - rim && along <= kLength * side + rim && across <= kShaftHalf * side + rim;
    return in_head || in_shaft;
  }
};

Color mixed(Color a, Color b, double share) {
  const auto mix = [&](std::uint8_t from, std::uint8_t to) {
    return std::uint8_t(std::lround(from + (double(to) - from) * share));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// Returns the direction in which an arrow at the point of a panel goes, of length 1: from the nearest corner.
Point direction_at(double x, double y, double side) {
  const double diagonal = std::sqrt(0.5);
  return {x < side / 2 ? diagonal : -diagonal, y < side / 2 ? diagonal : -diagonal};
}

/// Returns the direction of the arrow such that its tail stays in the panel.
Point direction_within(double x, double y, double side) {
  Point d = direction_at(x, y, side);
  const double tail = (kLength + kTextSize) * side;
  if (x - tail * d[0] < 0 || x - tail * d[0] > side) d[0] = -d[0];
  if (y - tail * d[1] < 0 || y - tail * d[1] > side) d[1] = -d[1];
  return d;
}

}  // namespace

void draw_mark(Image& image, int left, int top, int side, double x, double y, const std::string& text,
               Typeface* typeface) {
  const double px = x - left, py = y - top;
  if (!(px >= 0 && py >= 0 && px < side && py < side)) return;
  const Point d = direction_within(px, py, side);
  const Arrow arrow{double(side)};
  const double rim = std::max(1.0, kRimWidth * side);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      int inside = 0, around = 0;
      for (int ray = 0; ray < kRays * kRays; ++ray) {
        const int across = ray % kRays, down = ray / kRays;
        const double u = i + (across + 0.5) / kRays - px, v = j + (down + 0.5) / kRays - py;
        const Point p{u * d[0] + v * d[1], v * d[0] - u * d[1]};
        inside += int(arrow.holds(p, 0));
        around += int(arrow.holds(p, rim));
      }
      if (around == 0) continue;
      Color& pixel = image.at(left + i, top + j);
      pixel = mixed(pixel, kRim, double(around) / (kRays * kRays));
      pixel = mixed(pixel, kArrow, double(inside) / (kRays * kRays));
    }
  }
  if (typeface == nullptr || text.empty()) return;
  const int size = std::max(9, int(kTextSize * side));
  const double reach = kLength * side + 0.7 * size;
  typeface->draw(image, int(x - reach * d[0]) - typeface->width(text, size) / 2, int(y - reach * d[1]) + size / 3, text,
                 size, kArrow);
}

}  // namespace bp
