#pragma once
#include <span>

#include "lib/core/triangle_source.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Makes a closed mesh around `scene` embedded, if few of its faces are at fault: have no area, meet others, touch the
/// scene, or come as near to it as it may be off. A disc of faces around each fault is replaced by a tent: faces
/// between the disc's rim and an apex outside. If no tent fits, a wider one is tried. Returns whether the mesh is then
/// embedded with each triangle of the scene strictly inside, which is decided exactly. Returns false at once if more
/// than one face of fifty is at fault. Parallel; the result does not depend on the number of threads. Cost: two queries
/// of a box tree for each face in each of at most 6 rounds.
[[nodiscard]] bool mend_around(LatticeMesh& mesh, std::span<const TriangleD> scene, const Rounding& rounding);

}  // namespace bp
