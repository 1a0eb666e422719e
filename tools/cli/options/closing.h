#pragma once
#include <optional>
#include <string>

#include "lib/grid/stream.h"
#include "tools/cli/args.h"

/// The closing: bpclose and bplod declare the same options.
namespace bp {

struct ClosingOptions {
  std::optional<Length> scale;
  StructuringElement element = StructuringElement::cube;

  /// The scale. scale_of, scale_default: for help, " of the finest level" and " (default: ...)"; may be empty.
  void add_to(Args& args, const std::string& scale_of, const std::string& scale_default);
  void add_element(Args& args);
};

}  // namespace bp
