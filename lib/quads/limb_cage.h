#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"
#include "lib/quads/limbs.h"

/// Makes the cage of a model, and keeps its limbs apart where the faces suffice.
namespace bp {

/// Returns a cage of at most `faces` triangles around `enclosed`, whose voxels are `voxels`. First it is made of few
/// boxes (cell_quads.h). If limbs grow together in it, it is made of many small cubes, which are thinned out
/// (thin_quads.h), in two ways. The cage with the most limbs apart is returned; of equal ones, the first. The result is
/// empty if there are too few faces for any. Deterministic.
[[nodiscard]] LatticeMesh cage_with_limbs(const BrickShelf& voxels, const GridFrame& frame, const Enclosed& enclosed,
                                          std::uint64_t faces, const std::optional<MirrorPlane>& plane,
                                          const Limbs& model, std::vector<LatticeCoord>& joined);

}  // namespace bp
