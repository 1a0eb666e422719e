#pragma once
#include "lib/grid/scale_field.h"
#include "lib/mesh/edge_limit.h"

namespace bp {

/// No edge longer than `factor` times S anywhere along it; but never below two voxels, or nothing could be merged where
/// the scale vanishes. Keeps references; thread-safe. Cost: as ScaleField::reaches_along(), of the rules near the edge.
[[nodiscard]] EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor);

}  // namespace bp
