#pragma once
#include "lib/core/coords.h"

namespace bp {

/// Returns true if the triangle has exactly no area: its corners are collinear, or two of them are equal. Exact for
/// finite coordinates that are 0 or between 1e-90 and 1e90 in magnitude. About 10 ns; 1 us where doubles cannot decide.
[[nodiscard]] bool is_degenerate(const TriangleD& t);

}  // namespace bp
