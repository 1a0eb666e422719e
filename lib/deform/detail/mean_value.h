#pragma once
#include <span>

#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// The mean value weights of kWide points, not divided by their sum, as scratch.sums. `points` are in the
/// unit of the cage. Bit k of the result: point k lies so near to a vertex, an edge or a face, or in line with so thin
/// a face, that its weights are not to be trusted. `total` is their sum.
unsigned mean_value_weights(const CageView& cage, const WideVec& points, CoordinateScratch& scratch, Wide& total);

/// The same for one point, in extended precision and without the trust. Slow.
void mean_value_weights_slowly(const Cage& cage, const Vec3d& point, std::span<double> weights);

/// face_shares() of all faces for point number `lane`, the same way.
void face_shares_slowly(const Cage& cage, const Vec3d& point, std::size_t lane, CoordinateScratch& scratch);

}  // namespace bp::detail
