#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/pass/mesh/mesh_params.h"
#include "tools/cli/args.h"
#include "tools/run/origin.h"

/// The options that tell how a proxy relates to its scene (mode, enclosed set), as bpmesh and bplod declare them.
namespace bp {

/// The value of --enclose: the set that stays inside while a proxy is tightened, and the surface that a fit follows.
struct EncloseOption {
  enum class Kind { automatic, scene, input, closing, files };
  Kind kind = Kind::automatic;
  std::vector<std::string> files;  ///< for Kind::files

  /// Returns the option's text, with names of files only: paths do not belong in a report or a provenance chain.
  [[nodiscard]] std::string text() const;
  /// Returns scene, input or closing; empty for automatic and files.
  [[nodiscard]] std::optional<Enclose> what() const;
};

/// Parses the words given to --enclose; without words: automatic. Throws bad_argument for a mixture.
[[nodiscard]] EncloseOption parse_enclose(const std::vector<std::string>& given);

struct ProxyOptions {
  MeshMode mode = MeshMode::bounding;
  bool visual = false;      ///< levels to be looked at: the scene's own triangles, or fewer, or a fit
  bool mode_given = false;  ///< --mode was given (streams only)
  EncloseOption enclose;
  OriginOption origin;

  /// Declares them for a stream: every mode, and --enclose may name files.
  void add_of_stream(Args& args);
  /// Declares them for a scene: the modes bounding, fit and visual, and --enclose takes no files.
  void add_of_scene(Args& args);
  /// Parses what was given. After args.parse().
  void check();

 private:
  enum class LevelMode { bounding, fit, visual };
  LevelMode level_mode_ = LevelMode::bounding;  // of a scene
  std::vector<std::string> enclose_words_;
};

}  // namespace bp
