#pragma once
#include "lib/simplify/simplify.h"
#include "lib/tighten/tighten.h"

/// Thins (thin.h) and tightens (tighten.h) the regions of a large proxy (regions.h), several at the same time. The
/// proxy must be closed, 2-manifold, embedded and enclosing; it stays so. The result does not depend on the number of
/// threads.
namespace bp {

/// Tightens a proxy that is changed further afterwards: the result may be larger.
void tighten_regions_on(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                        TightenCounts& counts);

/// Collapses edges by volume down to `faces` if possible, and tightens with `settle` between stages.
void thin_regions(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, const TightenParams& settle,
                  SimplifyCounts& counts);

/// Tightens to the end. The proxy stays unchanged if the result would be larger.
void tighten_regions(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params, TightenCounts& counts);

}  // namespace bp
