#pragma once
#include <string>

namespace bp {

/// One step of the chain that made a stream or a mesh. It has no paths and no time of day.
struct Provenance {
  std::string tool, version;
  std::string options;  ///< canonical text of the options that change the result, defaults included, in a fixed order
  std::string input_hash;  ///< XXH3-128 of the step's input, hex; empty if unknown
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

}  // namespace bp
