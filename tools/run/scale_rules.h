#pragma once
#include <string>

#include "lib/grid/stream.h"

namespace bp {

/// Reads a file of rules (docs/bpscale.1.md) for the scene and the grid of `header`. Without `measure`, rules by shape
/// are refused. Throws bad_input with the key at fault.
[[nodiscard]] ScaleField read_rules(const std::string& file, const StreamHeader& header,
                                    const decltype(RuleContext::measure)& measure = {},
                                    const decltype(RuleContext::orientation)& orientation = {});

/// A field for the provenance: its JSON, or the hash of that where it is long; the header holds all of it.
[[nodiscard]] std::string provenance_text(const ScaleField& field);
/// The same of any rules as JSON; `what`: of the hash.
[[nodiscard]] std::string provenance_text(const std::string& json, const std::string& what);

}  // namespace bp
