#pragma once
#include "lib/grid/scale_field.h"
#include "lib/mesh/edge_limit.h"

namespace bp {

/// Returns a limit on edges: `factor` times the least S along the edge. Edges up to two voxels are always allowed,
/// since nothing could be merged where the scale vanishes. Keeps references; thread-safe. Cost: as
/// ScaleField::reaches_along(), for the rules near the edge.
[[nodiscard]] EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor);

}  // namespace bp
