#include "lib/image/color_bar.h"

#include <algorithm>
#include <cmath>

namespace bp {

Color color_on_bar(double t) {
  constexpr Color kStops[] = {{36, 30, 110}, {32, 100, 165}, {50, 155, 145}, {150, 195, 90}, {250, 228, 80}};
  constexpr int kSteps = 4;
  const double at = t > 0 ? kSteps * std::min(t, 1.0) : 0;
  const int i = std::min(int(at), kSteps - 1);
  const auto mix = [&](std::uint8_t a, std::uint8_t b) {
    return std::uint8_t(std::lround(a + (at - i) * (double(b) - a)));
  };
  const Color &a = kStops[i], &b = kStops[i + 1];
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

}  // namespace bp
