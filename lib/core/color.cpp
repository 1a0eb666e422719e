#include "lib/core/color.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

constexpr double kFull = 65535;

double linear_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
double srgb_of(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}
std::uint16_t fixed(double x) {
  return x > 0 ? std::uint16_t(std::min(x, 1.0) * kFull + 0.5) : std::uint16_t(0);  // NaN is 0 as well
}
std::uint8_t byte_of(double x) {
  return std::uint8_t(x * 255 + 0.5);
}

/// A table: scenes repeat the same few values, and pow() is slow.
const std::array<std::uint16_t, 256>& linear_of_bytes() {
  static const std::array<std::uint16_t, 256> table = [] {
    std::array<std::uint16_t, 256> t{};
    for (std::size_t i = 0; i < 256; ++i) t[i] = fixed(linear_of(double(i) / 255));
    return t;
  }();
  return table;
}

std::uint16_t fixed_from_srgb(double x) {
  const double steps = x * 255;
  if (steps >= 0 && steps <= 255 && steps == std::floor(steps)) return linear_of_bytes()[std::size_t(steps)];
  return fixed(linear_of(x));
}

}  // namespace

LinearColor color_from_linear(const std::array<double, 3>& rgb) {
  return {fixed(rgb[0]), fixed(rgb[1]), fixed(rgb[2])};
}

LinearColor color_from_srgb(const std::array<double, 3>& rgb) {
  return {fixed_from_srgb(rgb[0]), fixed_from_srgb(rgb[1]), fixed_from_srgb(rgb[2])};
}

std::array<std::uint8_t, 3> linear_bytes(LinearColor c) {
  return {byte_of(c.r / kFull), byte_of(c.g / kFull), byte_of(c.b / kFull)};
}

std::array<std::uint8_t, 3> srgb_bytes(LinearColor c) {
  return {byte_of(srgb_of(c.r / kFull)), byte_of(srgb_of(c.g / kFull)), byte_of(srgb_of(c.b / kFull))};
}

}  // namespace bp
