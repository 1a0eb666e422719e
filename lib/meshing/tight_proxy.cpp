#include "lib/meshing/tight_proxy.h"

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
  if (tightened.volume_after < tightened.volume_before) proxy = mesh.compact(proxy.frame);
}

}  // namespace

LatticeMesh tight_proxy(const LatticeMesh& dense, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  simplified = {};
  tightened = {};
  if (dense.triangles.empty()) return dense;
  TightenParams tightening;
  tightening.edge_limit = params.edge_limit;
  tightening.limits = params.limits;
  SimplifyParams early = params;
  early.faces = kEarlyFactor * params.faces;
  LatticeMesh proxy = simplify(dense, early, simplified);
  if (params.faces > 0 || params.limits != nullptr) {
    TightenParams few = tightening;
    few.sweeps = kEarlySweeps;
    proxy = tighten(proxy, enclosed, few, tightened);
    const double factor = by_volume(params) ? kLateFactor : 1;
    simplify_late(proxy, enclosed, params, std::uint64_t(factor * double(params.faces)), simplified);
  }
  finish(proxy, enclosed, params, tightening, simplified, tightened);
  if (by_volume(params) && proxy.triangles.size() > params.faces) {  // growing may go on where nothing else does
    simplify_late(proxy, enclosed, params, params.faces, simplified);
    finish(proxy, enclosed, params, tightening, simplified, tightened);
  }
  proxy.provenance = dense.provenance;
  return proxy;
}

}  // namespace bp
