#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/levels/level_request.h"
#include "tools/cli/length.h"

/// The levels that a command line asks for. lib/levels/level_request.h says what follows from it.
namespace bp {

struct LevelOptions {
  std::optional<std::uint64_t> levels;
  std::vector<std::uint64_t> faces;
  std::vector<double> shares;  ///< faces, in percent of the scene's triangles
  std::vector<Length> errors;
  std::vector<double> pixels;  ///< the same: the diagonal's size on screen at which the error is a pixel
  std::optional<Length> scale;
};

/// Comma-separated lists. Throw bad_argument if a number is none, is zero, or if the list does not fall (errors: rise).
[[nodiscard]] std::vector<Length> parse_errors(const std::string& text);
[[nodiscard]] std::vector<double> parse_pixels(const std::string& text);

/// Throws bad_argument if the options contradict each other.
void check(const LevelOptions& options);

/// In scene units. Without a scene, only the numbers and the lengths of lists mean something.
[[nodiscard]] LevelRequest request_of(const LevelOptions& options, double diagonal = 1, double voxel = 1);

[[nodiscard]] inline std::size_t level_count(const LevelOptions& o) {
  return level_count(request_of(o));
}
[[nodiscard]] inline bool asks_for_faces(const LevelOptions& o) {
  return asks_for_faces(request_of(o));
}
[[nodiscard]] inline bool asks_for_nothing(const LevelOptions& o) {
  return asks_for_nothing(request_of(o));
}

}  // namespace bp
