#pragma once
#include <vector>

#include "lib/core/indexed_mesh.h"

namespace bp::reference {

/// Mean value coordinates of a point inside a cage, by a loop over the faces as [JSW05] writes it, without SIMD, shared
/// edges or care near faces.
void mean_value(const IndexedMesh& cage, const Vec3d& point, std::vector<double>& weights);

}  // namespace bp::reference
