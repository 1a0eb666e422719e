#pragma once
#include <optional>
#include <string>

#include "io/mesh/mesh_writer.h"
#include "tools/cli/common_options.h"
#include "tools/cli/options/levels.h"
#include "tools/cli/options/mesh.h"

/// The command line of bpmesh.
namespace bp {

struct MeshOptions {
  CommonOptions common;
  std::string in = "-", out;
  ProxyOptions proxy;
  LevelOptions levels;
  double volume = 0;
  bool quads = false;

  /// Nothing, or the bound.
  [[nodiscard]] std::optional<Length> error() const {
    return levels.errors.empty() ? std::nullopt : std::optional(levels.errors.front());
  }
};

/// Throws bad_argument if options contradict each other.
[[nodiscard]] MeshOptions parse_mesh_options(Args& args);

/// proxy.glb, or proxy.0.glb and so on if there are several levels. After output_format(). Throws bad_argument if
/// stdout is to take several.
[[nodiscard]] std::string level_name(const MeshOptions& options, std::size_t level);
/// By the name of the output; stdout is GLB. Throws bad_argument if the name tells none, or if the format holds no
/// quads that are asked for.
[[nodiscard]] MeshFormat output_format(const MeshOptions& options);

}  // namespace bp
