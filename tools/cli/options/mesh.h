#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/pass/mesh/mesh_pass.h"
#include "tools/cli/args.h"
#include "tools/run/origin.h"

/// What a proxy is to what it is made of: bpmesh and bplod declare the same options.
namespace bp {

/// What stays inside while a proxy is tightened, and the surface that a fit follows.
struct EncloseOption {
  enum class Kind { automatic, scene, input, closing, files };
  Kind kind = Kind::automatic;
  std::vector<std::string> files;  ///< for Kind::files

  /// As given, but files by their names only: a path is nobody's business in a report or a provenance chain.
  [[nodiscard]] std::string text() const;
  /// scene, input or closing; empty: automatic, or files.
  [[nodiscard]] std::optional<Enclose> what() const;
};

/// Of the words given to --enclose; none: automatic. Throws bad_argument if they are a mixture.
[[nodiscard]] EncloseOption parse_enclose(const std::vector<std::string>& given);

struct ProxyOptions {
  MeshMode mode = MeshMode::bounding;
  bool mode_given = false;  ///< of a stream
  EncloseOption enclose;
  OriginOption origin;

  /// Of a stream: every mode, and --enclose may name files.
  void add_of_stream(Args& args);
  /// Of a scene: the modes bounding and fit, and --enclose takes no files.
  void add_of_scene(Args& args);
  /// After args.parse(), of a stream: reads the words given to --enclose.
  void check();

 private:
  std::vector<std::string> enclose_words_;
};

}  // namespace bp
