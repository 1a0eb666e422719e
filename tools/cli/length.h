#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "lib/core/coords.h"

/// Quantities as the command line writes them. Parsing is strict: a number, its unit, nothing else; no locale.
namespace bp {

/// The number that `text` spells, whole: decimal or scientific, finite. Throws bad_argument otherwise.
[[nodiscard]] double parse_number(std::string_view text);
/// The integer in [lo, hi] that `text` spells, whole. Throws bad_argument otherwise.
[[nodiscard]] std::int64_t parse_integer(std::string_view text, std::int64_t lo, std::int64_t hi);

/// The same of a count, which may be in thousands, millions or billions: `2k`, `1.5M`, `1G`, powers of 1000.
[[nodiscard]] std::int64_t parse_count(std::string_view text, std::int64_t lo, std::int64_t hi);

/// Calls f for each item of a comma-separated list, in order.
void for_each_item(std::string_view text, const std::function<void(std::string_view)>& f);

/// `X,Y,Z`. Throws bad_argument otherwise.
[[nodiscard]] Vec3d parse_point(std::string_view text);

/// Bytes: `4096`, `512K`, `1.5G`, `4GiB`; units are powers of 1024. Throws bad_argument if it is not a size below 2^62.
[[nodiscard]] std::uint64_t parse_size(std::string_view text);
[[nodiscard]] std::string size_text(std::uint64_t bytes);  ///< for people: "1.5 GiB"

/// A LENGTH: `0.5` scene units, `2%` of the diagonal of the scene's bounding box, or `20vx` voxels. Never negative. As
/// a bound on errors also `800px`: a pixel, where the diagonal is 800 pixels on screen.
struct Length {
  enum class Unit { scene, percent, voxels, pixels };
  double value = 0;
  Unit unit = Unit::scene;

  /// Scene units. `diagonal` and `voxel` are in scene units; 0 says "not known here", and a length that needs it throws
  /// bad_argument.
  [[nodiscard]] double in_world(double diagonal, double voxel) const;
  [[nodiscard]] std::string text() const;  ///< canonical: parse_length gives the same length again
  friend bool operator==(const Length&, const Length&) = default;
};
/// Throws bad_argument if `text` is no length, negative or not finite.
[[nodiscard]] Length parse_length(std::string_view text);
/// The same, of a bound on errors, which may be in pixels. It is above 0.
[[nodiscard]] Length parse_error_length(std::string_view text);

}  // namespace bp
