#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// The axis of a scene that points up. glTF has y up. A scene with another axis is turned by a quarter or half turn,
/// which rounds nothing.
namespace bp {

enum class UpAxis : std::uint8_t { y, z, x, minus_x, minus_y, minus_z };  ///< by their numbers in docs/brick-stream.md

constexpr std::array<const char*, 6> kUpNames{"y", "z", "x", "-x", "-y", "-z"};  ///< by number

[[nodiscard]] constexpr const char* name_of(UpAxis up) {
  return kUpNames[std::size_t(up)];
}
/// Returns the axis of "y", "-x", ...; empty for any other text.
[[nodiscard]] constexpr std::optional<UpAxis> up_axis_named(std::string_view name) {
  for (std::size_t i = 0; i < kUpNames.size(); ++i) {
    if (name == kUpNames[i]) return UpAxis(i);
  }
  return {};
}

/// A turn of the axes: coordinate i of the result is coordinate `axis[i]`, negated where `negative[i]`.
struct AxisTurn {
  std::array<std::uint8_t, 3> axis;
  std::array<bool, 3> negative;

  /// Turns a vector, exactly. Zeros stay positive.
  template <class Vector>
  [[nodiscard]] constexpr Vector operator()(const Vector& v) const {
    Vector out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto c = v[axis[i]];
      out[i] = negative[i] ? decltype(c)(0) - c : c;
    }
    return out;
  }
  [[nodiscard]] constexpr AxisTurn inverse() const {
    AxisTurn back{};
    for (std::size_t i = 0; i < 3; ++i) {
      back.axis[axis[i]] = std::uint8_t(i);
      back.negative[axis[i]] = negative[i];
    }
    return back;
  }
};

/// Returns the turn from a scene's axes to those of glTF, where y is up: the axis `up` becomes y.
///   y: (x, y, z)   z: (x, z, -y)   x: (-y, x, z)   -x: (y, -x, z)   -y: (x, -y, -z)   -z: (x, -z, y)
[[nodiscard]] constexpr AxisTurn to_y_up(UpAxis up) {
  constexpr std::array<AxisTurn, 6> kTurns{{{{0, 1, 2}, {false, false, false}},
                                            {{0, 2, 1}, {false, false, true}},
                                            {{1, 0, 2}, {true, false, false}},
                                            {{1, 0, 2}, {false, true, false}},
                                            {{0, 1, 2}, {false, true, true}},
                                            {{0, 2, 1}, {false, true, false}}}};
  return kTurns[std::size_t(up)];
}

/// Turns a vector from one scene's axes to another's: up stays up.
template <class Vector>
[[nodiscard]] constexpr Vector turned(const Vector& v, UpAxis from, UpAxis to) {
  return from == to ? v : to_y_up(to).inverse()(to_y_up(from)(v));
}

}  // namespace bp
