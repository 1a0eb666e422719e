#pragma once
#include <span>

#include "lib/core/triangle_source.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Makes a closed mesh around `scene` embedded where few of its faces are at fault: have no area, meet others, or touch
/// the scene or come as near to it as it may be off by. A disc of faces around a fault gives way to a tent: the faces
/// between the disc's rim and an apex outside. Where no tent has a place, a wider one is tried. Returns whether the
/// mesh is embedded then, with each triangle of the scene strictly inside; decided exactly. False at once if more than
/// one face of fifty is at fault. Parallel; the same for any number of threads. Cost: two queries of a box tree a face,
/// for each of a few rounds.
[[nodiscard]] bool mend_around(LatticeMesh& mesh, std::span<const TriangleD> scene, const Rounding& rounding);

}  // namespace bp
