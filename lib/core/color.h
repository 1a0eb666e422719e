#pragma once
#include <array>
#include <cstdint>

/// Colours of scenes. They are averaged in linear light: a mean of sRGB values is too dark.
namespace bp {

/// Linear light with the primaries of sRGB; 65535 is all there is.
struct LinearColor {
  std::uint16_t r = 65535, g = 65535, b = 65535;
  friend auto operator<=>(const LinearColor&, const LinearColor&) = default;
};
constexpr LinearColor kWhite{};

using TriangleColors = std::array<LinearColor, 3>;  ///< of the corners of a triangle; between them they are linear

/// From numbers in [0, 1]; what lies outside is clamped, NaN is 0.
[[nodiscard]] LinearColor color_from_linear(const std::array<double, 3>& rgb);
/// The same for values with the transfer function of sRGB (IEC 61966-2-1), as screens show them.
[[nodiscard]] LinearColor color_from_srgb(const std::array<double, 3>& rgb);

/// Nearest 8-bit values, linear and with the transfer function of sRGB.
[[nodiscard]] std::array<std::uint8_t, 3> linear_bytes(LinearColor c);
[[nodiscard]] std::array<std::uint8_t, 3> srgb_bytes(LinearColor c);

}  // namespace bp
