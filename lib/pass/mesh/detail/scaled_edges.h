#pragma once
#include <atomic>
#include <cstdint>

#include "lib/grid/scale_field.h"
#include "lib/mesh/edge_limit.h"

namespace bp {

/// The work of scaled_edges(), for tests and measurements.
struct ScaledEdgeWork {
  std::atomic<std::uint64_t> parts{0};   ///< parts of the field that were looked up
  std::atomic<std::uint64_t> points{0};  ///< points at which S was evaluated
};

/// Returns a limit on edges: `factor` times the least S along the edge. Edges up to two voxels are always allowed,
/// since nothing could be merged where the scale vanishes. Keeps references; thread-safe. Cost: as
/// ScaleField::reaches_along(), for the rules near the edge; nothing for one of the last edges. `work`: counts the work
/// of fields of many rules; may be null.
[[nodiscard]] EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor,
                                     ScaledEdgeWork* work = nullptr);

}  // namespace bp
