#pragma once
#include <cstdint>

#include "lib/mesh/lattice_mesh.h"

/// Shells, the connected components of a closed and embedded mesh, decided in integers. A part is an outer shell with
/// all that lies within it.
namespace bp {

struct DroppedComponents {
  std::uint64_t parts = 0;
  double volume_vox = 0;  ///< voxels in them
};

/// Takes away the parts whose outer shell encloses less than `share` of what the largest encloses. `mesh` may be turned
/// inwards as a whole. Keeps all other triangles in their order. Cost: linear, and cavities times small parts.
DroppedComponents drop_small_components(LatticeMesh& mesh, double share);

}  // namespace bp
