#pragma once
#include <atomic>
#include <cstdint>

#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"
#include "lib/mesh/edge_limit.h"

namespace bp {

/// The work of scaled_edges(), for tests and measurements.
struct ScaledEdgeWork {
  std::atomic<std::uint64_t> parts{0};   ///< parts of the field that were looked up
  std::atomic<std::uint64_t> points{0};  ///< points at which S was evaluated
};

/// Returns a limit on edges: `factor` times the least S along the edge. Edges up to two voxels are always allowed,
/// since nothing could be merged where the scale vanishes. Keeps references; thread-safe. Cost: a
/// bound of S near the edge, or some points of S along it, for the rules near the edge; nothing for one of the last
/// edges. `work`: counts the work; may be null.
/// `near`: the voxels that a surface lies around, in `frame`; may be null. Edges of any length are allowed within
/// `factor` / 8 times the least S along the edge, and a voxel, of these voxels. So a smooth place takes no more faces
/// than its shape needs, however fine it is. Inside of the voxels everything is near: this suits surfaces that enclose
/// the voxels.
[[nodiscard]] EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor,
                                     const BrickShelf* near = nullptr, ScaledEdgeWork* work = nullptr);

/// Returns about the most bytes that a limit keeps for the question what is near.
[[nodiscard]] std::uint64_t bytes_of_near_edges(const ScaleField& scale, const GridFrame& frame,
                                                const BrickShelf& near);

}  // namespace bp
