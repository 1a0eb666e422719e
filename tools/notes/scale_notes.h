#pragma once
#include <string>
#include <vector>

#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"

/// What is allowed of a scale, but hardly meant.
namespace bp {

/// Name and place of a rule: "head: at 0,1,2", "box 0,0,0 to 1,1,1", "view 0,0,9 and 3 more".
[[nodiscard]] std::string rule_text(const ScaleRule& rule);

/// Sentences for the user: a scale that closes nothing, rules of the field that the closing cannot reach.
[[nodiscard]] std::vector<std::string> scale_notes(const ScaleField& field, const StreamHeader& header,
                                                   bool inner = false);

}  // namespace bp
