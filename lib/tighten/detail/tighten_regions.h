#pragma once
#include "lib/simplify/simplify.h"
#include "lib/tighten/tighten.h"

/// Thinning (thin.h) and tightening (tighten.h) on the regions of a large proxy (regions.h), at the same time. The
/// proxy: closed, 2-manifold, embedded, enclosing; it stays so. The result does not depend on the number of threads.
namespace bp {

/// Tightens on the way to something else: it may come out larger.
void tighten_regions_on(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                        TightenCounts& counts);

/// Collapses by volume down to `faces`, or as far as it goes, tightened with `settle` between stages.
void thin_regions(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, const TightenParams& settle,
                  SimplifyCounts& counts);

/// Tightens to the end; as it was if that made it larger.
void tighten_regions(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params, TightenCounts& counts);

}  // namespace bp
