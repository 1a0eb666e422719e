#pragma once
#include <optional>
#include <string>

#include "io/mesh/mesh_writer.h"
#include "tools/cli/common_options.h"
#include "tools/cli/options/levels.h"
#include "tools/cli/options/mesh.h"

/// The options of bpmesh.
namespace bp {

struct MeshOptions {
  CommonOptions common;
  std::string in = "-", out;
  ProxyOptions proxy;
  LevelOptions levels;
  double volume = 0;
  std::optional<double> edge_factor;  ///< none: edges follow the scale and the shape
  bool quads = false;

  /// Returns the bound of --error, if given.
  [[nodiscard]] std::optional<Length> error() const {
    return levels.errors.empty() ? std::nullopt : std::optional(levels.errors.front());
  }
};

/// Declares and parses the options. Throws bad_argument if they contradict each other.
[[nodiscard]] MeshOptions parse_mesh_options(Args& args);

/// Returns proxy.glb, or proxy.0.glb and so on if there are several levels. To be called after output_format(). Throws
/// bad_argument if several levels would go to stdout.
[[nodiscard]] std::string level_name(const MeshOptions& options, std::size_t level);
/// Returns the format that the output's name tells; stdout is GLB. Throws bad_argument if the name tells none, or if
/// quads are asked for and the format cannot hold them.
[[nodiscard]] MeshFormat output_format(const MeshOptions& options);

}  // namespace bp
