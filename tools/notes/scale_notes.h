#pragma once
#include <string>
#include <vector>

#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"

/// Notes on scales that are allowed, but hardly meant.
namespace bp {

/// Returns a text that tells a rule from others: its name if it has one, then its kind and first point: "head: at
/// 0,1,2", "box 0,0,0 to 1,1,1", "view 0,0,9 and 3 more".
[[nodiscard]] std::string rule_text(const ScaleRule& rule);

/// Returns notes on a scale that closes nothing, on rules that the closing cannot reach, and, if measured, on rules by
/// shape that find nothing.
[[nodiscard]] std::vector<std::string> scale_notes(const ScalePlan& plan, const StreamHeader& header);

/// Returns notes on rules by shape with a length below a voxel.
[[nodiscard]] std::vector<std::string> short_length_notes(const ScalePlan& plan, double voxel);

}  // namespace bp
