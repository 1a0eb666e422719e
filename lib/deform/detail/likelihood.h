#pragma once
#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// Maximum likelihood coordinates of kWide points, as scratch.sums, not divided by their sum; none is negative.
/// mean_value_weights() left its vectors there, and gave `doubtful` and `total`: a point that is surely outside gets no
/// coordinates.
void likelihood_weights(const Cage& cage, const WideVec& points, unsigned doubtful, const Wide& total,
                        CoordinateScratch& scratch);

}  // namespace bp::detail
