#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"

/// Makes the cage of a model, and keeps its limbs apart where the faces suffice.
namespace bp {

/// The limbs of a model (limbs.h), and those that grow together in its cage.
struct CageLimbs {
  std::size_t count = 0;
  std::vector<LatticeCoord> joined;  ///< tips
};

/// Returns a cage of at most `faces` triangles around `enclosed`, whose voxels are `voxels`. First it is made of few
/// boxes (cell_quads.h). If limbs grow together in it, it is made of many small cubes, which are thinned out
/// (thin_quads.h), in two ways. The cage with the most limbs apart is returned; of equal ones, the first. The result is
/// empty if there are too few faces for any. Deterministic.
[[nodiscard]] LatticeMesh cage_with_limbs(const BrickShelf& voxels, const GridFrame& frame, const Enclosed& enclosed,
                                          std::uint64_t faces, const std::optional<MirrorPlane>& plane,
                                          CageLimbs& limbs);

}  // namespace bp
