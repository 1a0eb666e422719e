#include "tools/cli/help/option_owners.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tools/cli/help/nearest.h"

namespace bp {

namespace {

/// An option of some of the pipe's tools, and the names of these tools. A golden case (manuals) compares the table with
/// the tools.
struct OptionOfTools {
  const char *option, *tools;
};
constexpr OptionOfTools kOptionsOfTools[] = {
    {"--animate", "bpdeform"},
    {"--appearance", "bplod"},
    {"--boxes", "bpinfo"},
    {"--cache", "bplod"},
    {"--claimed", "bpcheck"},
    {"--convex", "bpcheck"},
    {"--coordinates", "bpdeform"},
    {"--device", "bpclose, bpdeform and bpview"},
    {"--crs", "bplod"},
    {"--dump", "bpinfo"},
    {"--edge-factor", "bpmesh"},
    {"--element", "bpclose and bpview"},
    {"--enclose", "bpmesh and bplod"},
    {"--error", "bpmesh and bplod"},
    {"--explain", "bpscale and bplod"},
    {"--faces", "bpmesh, bplod and bpview"},
    {"--field", "bpclose and bplod"},
    {"--fill", "bpvox, bplod and bpview"},
    {"--format", "bpvox, bpcheck, bplod, bpinfo and bpview"},
    {"--hull-corners", "bplod"},
    {"--hull-files", "bplod"},
    {"--hulls", "bplod"},
    {"--image", "bpinfo"},
    {"--image-size", "bpinfo"},
    {"--inputs", "bplod"},
    {"--inside", "bpcheck"},
    {"--json", "bpcheck and bpinfo"},
    {"--keep-cavities", "bpclose"},
    {"--leaves", "bplod"},
    {"--leaks", "bpinfo"},
    {"--level", "bpinfo"},
    {"--levels", "bplod"},
    {"--look-at", "bpinfo"},
    {"--margin", "bpcheck and bplod"},
    {"--memory", "bpvox, bpscale, bpclose, bpmesh, bpcheck, bpdeform, bplod, bpinfo and bpview"},
    {"--min-hidden", "bplod"},
    {"--mode", "bpmesh and bplod"},
    {"--name", "bplod"},
    {"--no-open", "bpview"},
    {"--origin", "bpmesh, bpcheck and bplod"},
    {"--output", "bpvox, bpscale, bpclose, bpmesh, bpdeform, bplod and bpview"},
    {"--outside", "bpdeform"},
    {"--overwrite", "bpvox, bpscale, bpclose, bpmesh, bpdeform, bplod, bpinfo and bpview"},
    {"--part", "bpcheck"},
    {"--pick", "bpinfo"},
    {"--place", "bplod"},
    {"--port", "bpview"},
    {"--profile", "bplod"},
    {"--progress", "bpvox, bpscale, bpclose, bpmesh, bpcheck, bpdeform, bplod and bpview"},
    {"--quads", "bpmesh"},
    {"--quiet", "bpvox, bpscale, bpclose, bpmesh, bpcheck, bpdeform, bplod and bpview"},
    {"--report", "bpvox, bpscale, bpclose, bpmesh, bpcheck, bpdeform and bplod"},
    {"--resolution", "bpvox, bplod, bpinfo and bpview"},
    {"--rooms", "bplod"},
    {"--rules", "bpview"},
    {"--scale", "bpclose and bplod"},
    {"--show", "bpview"},
    {"--symmetry", "bplod"},
    {"--temp", "bpvox, bpscale, bpclose, bpmesh, bpcheck, bpdeform, bplod, bpinfo and bpview"},
    {"--tile", "bplod"},
    {"--tile-compression", "bplod"},
    {"--tiles", "bplod"},
    {"--up", "bpvox, bplod, bpinfo and bpview"},
    {"--view", "bpinfo"},
    {"--volume", "bpmesh"},
    {"--voxel", "bpvox, bplod, bpinfo and bpview"},
    {"--zoom", "bpinfo"},
};

bool is_of_pipe(const std::string& tool) {
  constexpr const char* kPipe[] = {"bpvox", "bpscale", "bpclose",  "bpmesh", "bpcheck",
                                   "bplod", "bpinfo",  "bpdeform", "bpview"};
  return std::find(std::begin(kPipe), std::end(kPipe), tool) != std::end(kPipe);
}

}  // namespace

std::string owner_of(const std::string& tool, const std::string& name, bool similar) {
  if (!is_of_pipe(tool)) return "";
  std::vector<std::string> names;
  for (const OptionOfTools& o : kOptionsOfTools) names.push_back(o.option);
  const std::string meant = similar ? nearest_word(name, names) : name;
  for (const OptionOfTools& o : kOptionsOfTools) {
    if (o.option == meant) return fmt::format("; {} is an option of {}", meant, o.tools);
  }
  return "";
}

bool may_have_option(const std::string& tool, const std::string& name) {
  if (!is_of_pipe(tool)) return true;
  for (const OptionOfTools& o : kOptionsOfTools)
    if (o.option == name) return std::string(o.tools).find(tool) != std::string::npos;
  return true;
}

}  // namespace bp
