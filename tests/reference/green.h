#pragma once
#include <vector>

#include "lib/core/indexed_mesh.h"

namespace bp::reference {

/// Green coordinates of a point inside a cage, and on none of its planes: those of the vertices, then those of the
/// faces, by a loop over the faces as [LLC08] writes it.
void green(const IndexedMesh& cage, const Vec3d& point, std::vector<double>& weights);

}  // namespace bp::reference
