#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/cli/common_options.h"
#include "tools/cli/options/closing.h"
#include "tools/cli/options/voxel.h"

/// The command line of bpview.
namespace bp {

struct ViewOptions {
  CommonOptions common;
  VoxelOptions voxels;
  ClosingOptions closing;
  std::string rules = "rules.json", out = "proxy.glb";
  bool rules_given = false;        ///< go on from that file, and replace it when rules are saved
  std::vector<std::string> shown;  ///< files and folders to show beside the scene
  std::uint64_t faces = 1000;
  std::uint64_t port = 0;  ///< 0: a free one
  bool opens_browser = true;
};

/// Throws bad_argument if options contradict each other.
[[nodiscard]] ViewOptions parse_view_options(Args& args);

}  // namespace bp
