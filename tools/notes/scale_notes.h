#pragma once
#include <string>
#include <vector>

#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"

/// What is allowed of a scale, but hardly meant.
namespace bp {

/// Sentences for the user: a scale that closes nothing, boxes of the field that the closing cannot reach.
[[nodiscard]] std::vector<std::string> scale_notes(const ScaleField& field, const StreamHeader& header,
                                                   bool inner = false);

}  // namespace bp
