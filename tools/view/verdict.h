#pragma once
#include <string>

#include "tools/cli/report.h"

namespace bp {

/// Returns the part of a verdict of bpcheck that the page shows: answer, why, and for each level its triangles, volume,
/// ratio of volumes, and distance of its farthest point from the scene. Null if the text is no verdict.
[[nodiscard]] Json brief_verdict(const std::string& text);

}  // namespace bp
