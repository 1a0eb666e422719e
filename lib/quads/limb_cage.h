#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"
#include "lib/quads/limbs.h"
#include "lib/quads/thin_quads.h"

/// Makes the cage of a model, and keeps its limbs apart where the faces suffice.
namespace bp {

/// Returns a cage of at most `faces` triangles around `enclosed`, whose voxels are `voxels`. First it is made of few
/// boxes (cell_quads.h). If limbs of `model` grow together in it, it is made of many small cubes, which are thinned out
/// (thin_quads.h), in two ways; the second is left out if the first is hopeless. The cage that fits best is returned
/// (CageFit), and `fit` is set; of equal ones, the first. The result is empty if there are too few faces for any.
/// `steps`: of each way. Deterministic. Throws as thinned().
[[nodiscard]] LatticeMesh cage_with_limbs(const BrickShelf& voxels, const GridFrame& frame, const Enclosed& enclosed,
                                          std::uint64_t faces, const std::optional<MirrorPlane>& plane,
                                          const Limbs& model, CageFit& fit, const ThinningSteps& steps = {});

}  // namespace bp
