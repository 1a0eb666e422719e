#pragma once
#include "lib/meshing/simplify.h"
#include "lib/meshing/tighten.h"

/// From the dense surface to a tight proxy of a given number of faces.
namespace bp {

/// Growing collapses to a few times the target, tightening, then collapses that only keep `enclosed` inside, tightening
/// again: growth that a coarse face could not take back is never made (docs/decisions/0003-order-of-steps.md).
[[nodiscard]] LatticeMesh tight_proxy(const LatticeMesh& dense, const Enclosed& enclosed, const SimplifyParams& params,
                                      SimplifyCounts& simplified, TightenCounts& tightened);

}  // namespace bp
