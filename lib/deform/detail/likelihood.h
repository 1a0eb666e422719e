#pragma once
#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// Computes maximum likelihood coordinates of kWide points, as scratch.sums, not divided by their sum; none is
/// negative. mean_value_weights() must have left its vectors there, and gives `doubtful` and `total`: a point that is
/// surely outside gets no coordinates.
void likelihood_weights(const Cage& cage, const WideVec& points, unsigned doubtful, const Wide& total,
                        CoordinateScratch& scratch);

}  // namespace bp::detail
