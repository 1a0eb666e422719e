#pragma once
#include "lib/grid/stream.h"

/// The features of a solid that a surface of few faces must spend them on first.
namespace bp {

struct SolidTopology {
  std::uint64_t parts = 0;    ///< components of the voxels (6-neighbours)
  std::uint64_t handles = 0;  ///< holes through the parts, less the cavities in them; not below 0
};

/// Returns the topology of the voxels of `solid` as they are; lib/surface/repair.h closes the tiniest of the holes
/// later. Exact; the same for every number of threads. Memory: topology_bytes(), 20 for each run of voxels in a brick.
/// Linear except for sorting.
[[nodiscard]] SolidTopology topology_of(const BrickShelf& solid);
[[nodiscard]] std::uint64_t topology_bytes(const BrickShelf& solid);

}  // namespace bp
