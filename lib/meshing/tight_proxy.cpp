#include "lib/meshing/tight_proxy.h"

namespace bp {

LatticeMesh tight_proxy(const LatticeMesh& dense, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  constexpr std::uint64_t kEarlyFactor = 6;
  SimplifyParams early = params;
  early.faces = kEarlyFactor * params.faces;
  LatticeMesh proxy = simplify(dense, early, simplified);
  if (params.faces > 0 || params.limits != nullptr) {
    TightenParams few;
    few.sweeps = 6;
    few.edge_limit = params.edge_limit;
    few.limits = params.limits;
    proxy = tighten(proxy, enclosed, few, tightened);
    SimplifyParams late = params;
    late.dense = false;
    late.enclosed = &enclosed;
    SimplifyCounts grown = simplified;
    proxy = simplify(proxy, late, simplified);
    grown.add(simplified);
    simplified = grown;
  }
  TightenParams last;
  last.edge_limit = params.edge_limit;
  last.limits = params.limits;
  return tighten(proxy, enclosed, last, tightened);
}

}  // namespace bp
