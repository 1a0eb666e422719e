#pragma once
#include <span>

#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// Computes the mean value weights of kWide points as scratch.sums, not divided by their sum. `points` are in the unit
/// of the cage. Bit k of the result says that the weights of point k are unreliable: it lies too near to a vertex, an
/// edge or a face, or in line with too thin a face. `total` is the sum of the weights.
unsigned mean_value_weights(const CageView& cage, const WideVec& points, CoordinateScratch& scratch, Wide& total);

/// Computes them for one point, in extended precision and always reliably. Slow.
void mean_value_weights_slowly(const Cage& cage, const Vec3d& point, std::span<double> weights);

/// Computes face_shares() of all faces for point number `lane`, likewise.
void face_shares_slowly(const Cage& cage, const Vec3d& point, std::size_t lane, CoordinateScratch& scratch);

}  // namespace bp::detail
