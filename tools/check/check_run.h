#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/check/tileset_verdict.h"
#include "tools/cli/common_options.h"

/// The command line of bpcheck.
namespace bp {

struct CheckRun {
  CommonOptions common;
  std::vector<std::string> files;  // scenes, then the proxy
  std::string format;
  bool json = false, inside = false, convex = false;
  bool claimed = false;  // asks whether the claim of the proxy's file holds
  Length margin;         // 0: no margin is asked for
  TilePart part;
  std::optional<Vec3d> origin;
};

/// Throws bad_argument if options contradict each other.
[[nodiscard]] CheckRun parse_check_run(Args& args);

}  // namespace bp
