#pragma once
#include <array>
#include <cstdint>

/// Colours of scenes. They are averaged in linear light: a mean of sRGB values is too dark.
namespace bp {

/// A colour in linear light with the primaries of sRGB. 65535 is full intensity.
struct LinearColor {
  std::uint16_t r = 65535, g = 65535, b = 65535;
  friend auto operator<=>(const LinearColor&, const LinearColor&) = default;
};
constexpr LinearColor kWhite{};

using TriangleColors = std::array<LinearColor, 3>;  ///< at the corners of a triangle; colours are linear between them

/// Converts from numbers in [0, 1]. Numbers outside are clamped, and NaN becomes 0.
[[nodiscard]] LinearColor color_from_linear(const std::array<double, 3>& rgb);
/// Converts from values with the transfer function of sRGB (IEC 61966-2-1), as screens show them. Clamps likewise.
[[nodiscard]] LinearColor color_from_srgb(const std::array<double, 3>& rgb);

/// Return the nearest 8-bit values: linear ones, and ones with the transfer function of sRGB.
[[nodiscard]] std::array<std::uint8_t, 3> linear_bytes(LinearColor c);
[[nodiscard]] std::array<std::uint8_t, 3> srgb_bytes(LinearColor c);

}  // namespace bp
