#pragma once
#include <cstdint>

#include "lib/mesh/lattice_mesh.h"

/// Removes small parts of a closed and embedded mesh; all decisions are made in integers. A shell is a connected
/// component. A part is an outer shell with everything inside it.
namespace bp {

struct DroppedComponents {
  std::uint64_t parts = 0;
  double volume_vox = 0;  ///< volume of the dropped parts, in voxels
};

/// Removes the parts whose outer shell encloses less than `share` of what the largest one encloses. `mesh` may be
/// turned inwards as a whole. The other triangles keep their order. Cost: linear, plus the number of cavities times the
/// number of small parts.
DroppedComponents drop_small_components(LatticeMesh& mesh, double share);

}  // namespace bp
