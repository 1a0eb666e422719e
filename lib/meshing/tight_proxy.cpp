#include "lib/meshing/tight_proxy.h"

#include <algorithm>

#include "lib/meshing/thin.h"

namespace bp {

namespace {

constexpr std::uint64_t kEarlyFactor = 6;  // of the wanted faces: where growing collapses end
constexpr double kLateFactor = 1.5;        // where the order of collapses changes from quadric error to volume
constexpr int kEarlySweeps = 3;

/// Collapses by volume know neither errors nor limits.
bool by_volume(const SimplifyParams& params) {
  return params.faces > 0 && params.error_vox <= 0 && params.limits == nullptr;
}

void simplify_late(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params, std::uint64_t faces,
                   SimplifyCounts& counts) {
  SimplifyParams late = params;
  late.faces = faces;
  late.dense = false;
  late.enclosed = &enclosed;
  SimplifyCounts now;
  proxy = simplify(proxy, late, now);
  counts.add(now);
}

/// Collapses by volume, then the last tightening, on one mesh.
void finish(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params, const TightenParams& tightening,
            SimplifyCounts& simplified, TightenCounts& tightened) {
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, params.edge_limit, params.limits);
  if (by_volume(params) && mesh.face_count() > params.faces) {
    SimplifyCounts now;
    thin(editor, params.faces, now);
    simplified.add(now);
  }
  proxy = mesh.compact(proxy.frame);
  tighten(editor, tightening, tightened);
  if (tightened.volume_after > tightened.volume_before) {  // it was as tight as can be: a box around a box
    tightened.volume_after = tightened.volume_before;
  } else {
    proxy = mesh.compact(proxy.frame);
  }
}

/// Early tightening and collapses by volume find a finer balance, but jam in a few places where growing goes on.
template <class Surface>
LatticeMesh attempt(const Surface& dense, const Enclosed& enclosed, const SimplifyParams& params, bool tight_early,
                    SimplifyCounts& simplified, TightenCounts& tightened) {
  TightenParams tightening;
  tightening.edge_limit = params.edge_limit;
  tightening.limits = params.limits;
  if (params.limits != nullptr) {  // they refuse what the barrier takes back first
    tightening.sweeps = 0;
    tightening.final_sweeps = 10;
  }
  SimplifyParams early = params;
  if (tight_early) early.faces = kEarlyFactor * params.faces;
  LatticeMesh proxy = simplify(dense, early, simplified);
  if (proxy.triangles.empty()) return proxy;
  if (tight_early && (params.faces > 0 || params.limits != nullptr)) {
    TightenParams few = tightening;
    few.sweeps = std::min(few.sweeps, kEarlySweeps);
    proxy = tighten(proxy, enclosed, few, tightened);
    const double factor = by_volume(params) ? kLateFactor : 1;
    simplify_late(proxy, enclosed, params, std::uint64_t(factor * double(params.faces)), simplified);
  }
  finish(proxy, enclosed, params, tightening, simplified, tightened);
  return proxy;
}

/// Of a SurfaceSource or a LatticeMesh.
template <class Surface>
LatticeMesh better_attempt(const Surface& dense, const Enclosed& enclosed, const SimplifyParams& params,
                           SimplifyCounts& simplified, TightenCounts& tightened) {
  simplified = {};
  tightened = {};
  LatticeMesh proxy = attempt(dense, enclosed, params, true, simplified, tightened);
  if (by_volume(params) && proxy.triangles.size() > params.faces) {
    SimplifyCounts simplified_again;
    TightenCounts tightened_again;
    LatticeMesh grown = attempt(dense, enclosed, params, false, simplified_again, tightened_again);
    if (grown.triangles.size() < proxy.triangles.size()) {
      proxy = std::move(grown);
      simplified = simplified_again;
      tightened = tightened_again;
    }
  }
  return proxy;
}

}  // namespace

LatticeMesh tight_proxy(const SurfaceSource& dense, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  return better_attempt(dense, enclosed, params, simplified, tightened);
}

LatticeMesh tight_proxy(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  LatticeMesh proxy = better_attempt(mesh, enclosed, params, simplified, tightened);
  proxy.provenance = mesh.provenance;
  return proxy;
}

}  // namespace bp
