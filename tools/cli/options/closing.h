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

  /// The scale. scale_of: for help, " of the finest level"; may be empty. scale_more: the end of the help, with the
  /// default.
  void add_to(Args& args, const std::string& scale_of, const std::string& scale_more);
  void add_element(Args& args);
};

}  // namespace bp
