#pragma once
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/grid/scale_field.h"
#include "lib/image/color_bar.h"

namespace bp {

/// Colours triangles by the scale at their corners, from color_on_bar(0) for the least scale to color_on_bar(1) for the
/// largest. Returns the numbers at the ends of the bar.
[[nodiscard]] ColorBar color_by_scale(const ScaleField& scale, const std::vector<TriangleD>& triangles,
                                      std::vector<TriangleColors>& colors);

}  // namespace bp
