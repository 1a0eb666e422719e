#pragma once
#include <optional>
#include <string>

#include "lib/grid/stream.h"
#include "tools/cli/args.h"

/// The options of the closing, as bpclose and bplod declare them.
namespace bp {

struct ClosingOptions {
  std::optional<Length> scale;
  StructuringElement element = StructuringElement::cube;

  /// Declares the scale. scale_of: help text, such as " of the finest level"; may be empty. scale_more: the end of the
  /// help, with the default.
  void add_to(Args& args, const std::string& scale_of, const std::string& scale_more);
  void add_element(Args& args);
};

}  // namespace bp
