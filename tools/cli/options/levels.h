#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/args.h"

/// How fine the proxies are: bpmesh and bplod declare the same options.
namespace bp {

struct LevelOptions {
  std::vector<std::uint64_t> faces;  ///< of each level, finest first
  std::vector<double> shares;        ///< the same in percent of the scene's triangles; either this or faces
  std::vector<Length> errors;        ///< of each level, finest first
  std::optional<std::uint64_t> levels;

  /// Of a stream, whose triangles nobody has counted: --faces without percentages, and one --error.
  void add_of_stream(Args& args);
  /// Of a scene: --levels, too. faces_default, levels_default: texts for help.
  void add_of_scene(Args& args, const std::string& levels_default, const std::string& faces_default);
};

/// "0.1,0.2,0.4": lengths above 0 that rise. Throws bad_argument otherwise, and for voxels as a unit.
[[nodiscard]] std::vector<Length> parse_error_list(const std::string& text);

}  // namespace bp
