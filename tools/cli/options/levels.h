#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/args.h"

/// The options that tell how fine proxies are, as bpmesh and bplod declare them.
namespace bp {

struct LevelOptions {
  std::vector<std::uint64_t> faces;  ///< faces of each level, finest first
  std::vector<double> shares;  ///< the same as percentages of the scene's triangles; only one of both lists is used
  std::vector<Length> errors;  ///< errors of each level, finest first
  std::optional<std::uint64_t> levels;

  /// Declares them for a stream, whose triangles are not counted: --faces without percentages, and one --error.
  void add_of_stream(Args& args);
  /// Declares them for a scene: with --levels. faces_default, levels_default: help texts.
  void add_of_scene(Args& args, const std::string& levels_default, const std::string& faces_default);
};

/// Parses "0.1,0.2,0.4": lengths above 0 that rise. Throws bad_argument otherwise, and for voxels as a unit.
[[nodiscard]] std::vector<Length> parse_error_list(const std::string& text);

}  // namespace bp
