#pragma once
#include <string>
#include <string_view>

/// Lengths as the command line and files of rules write them. Parsing is strict: a number, its unit and nothing else.
/// No locale has a say.
namespace bp {

/// Parses a number at the front of `text` and returns what follows it. Throws bad_argument if there is none: "'TEXT' is
/// not WHAT".
[[nodiscard]] std::string_view take_number(std::string_view text, double& value, std::string_view what);
/// Returns the number that is all of `text`: decimal or scientific, finite. Throws bad_argument otherwise.
[[nodiscard]] double parse_number(std::string_view text);

/// Throws bad_argument: "'TEXT' is not WHAT". If `unit` is the name of a unit such as cm, the message says that scenes
/// do not name their units.
[[noreturn]] void refuse_unit(std::string_view text, std::string_view unit, std::string_view what);

/// A LENGTH: `0.5` scene units, `2%` of the diagonal of the scene's bounding box, or `20vx` voxels. It is never
/// negative. A bound on errors may also be `800px`: one pixel of a picture in which the diagonal has 800 pixels.
struct Length {
  enum class Unit { scene, percent, voxels, pixels };
  double value = 0;
  Unit unit = Unit::scene;

  /// Converts to scene units. `diagonal` and `voxel` are in scene units. 0 says that one is not known here, and a
  /// length that needs it throws bad_argument.
  [[nodiscard]] double in_world(double diagonal, double voxel) const;
  [[nodiscard]] std::string text() const;  ///< canonical: parse_length() gives the same length again
  friend bool operator==(const Length&, const Length&) = default;
};
/// Throws bad_argument if `text` is no length, negative or not finite.
[[nodiscard]] Length parse_length(std::string_view text);
/// Parses a bound on errors, which may be in pixels and must be above 0. Throws likewise.
[[nodiscard]] Length parse_error_length(std::string_view text);

}  // namespace bp
