#include "lib/tighten/tight_proxy.h"

#include <algorithm>
#include <cmath>

#include "lib/simplify/collapse_regions.h"
#include "lib/tighten/detail/thin.h"
#include "lib/tighten/detail/tighten_regions.h"

namespace bp {

namespace {

// Growing collapses turn to strict order at a multiple of the wanted faces; at least at so many: these are quick.
constexpr std::uint64_t kEarlyStrict = 16, kEarlyStrictLeast = 10000;
constexpr std::uint64_t kEarlyFactor = 6;  // of the wanted faces: where growing collapses end
constexpr double kLateFactor = 1.5;        // where the order of collapses changes from quadric error to volume
constexpr double kMostGrowth = 6;          // of one collapse: some times a face's share of the volume
constexpr double kMuchRoom = 0.04;         // share of the volume: an early sweep that gains more is worth others

/// Collapses by volume know neither errors nor limits.
bool by_volume(const SimplifyParams& params) {
  return params.faces > 0 && params.error_vox <= 0 && params.limits == nullptr;
}

/// `enclosed`: what must stay inside; null: collapses grow. Those that know how far they may reach and do not get to
/// `faces` by that go on with a longer reach.
void simplify_late(LatticeMesh& proxy, const Enclosed* enclosed, const SimplifyParams& params, std::uint64_t faces,
                   SimplifyCounts& counts) {
  SimplifyParams late = params;
  late.faces = faces;
  late.dense = false;
  late.enclosed = enclosed;
  late.most_growth = enclosed != nullptr ? kMostGrowth : 0;
  for (bool again = true; again;) {
    SimplifyCounts now;
    proxy = simplify(proxy, late, now);
    counts.add(now);
    again = enclosed != nullptr && late.reach > 0 && now.stop != StopReason::faces && now.refused[Refusal::growth] > 0;
    if (again) late.reach = loosened(late.reach, params.reach);
  }
}

TightenParams one_sweep(const SimplifyParams& params) {
  TightenParams once = tightening_of(params);
  once.sweeps = 1;
  once.final_sweeps = 0;
  return once;
}

/// Collapses by volume, then the last tightening, on one mesh.
void finish_whole(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params,
                  SimplifyCounts& simplified, TightenCounts& tightened) {
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, params);
  if (by_volume(params) && mesh.face_count() > params.faces) {
    TightenCounts ignored;
    SimplifyCounts now;
    thin(
        editor, params.faces, [&] { tighten_on(editor, one_sweep(params), ignored); }, now);
    simplified.add(now);
  }
  proxy = tighten(editor, proxy.frame, tightening_of(params), tightened);
}

/// What regions could not collapse, on one mesh.
void thin_rest(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params, SimplifyCounts& simplified) {
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, params);
  SimplifyCounts now;
  thin(
      editor, params.faces, [] {}, now, kThinStages);
  simplified.add(now);
  editor.erase_inner_shells();
  const LatticeMesh out = mesh.compact(proxy.frame);
  proxy.vertices = out.vertices;
  proxy.triangles = out.triangles;
}

/// The same as finish_whole on regions, where it is large.
void finish(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params, SimplifyCounts& simplified,
            TightenCounts& tightened) {
  if (!has_regions(proxy.triangles.size(), params)) return finish_whole(proxy, enclosed, params, simplified, tightened);
  if (by_volume(params) && proxy.triangles.size() > params.faces) {
    SimplifyCounts now;
    thin_regions(proxy, enclosed, params.faces, one_sweep(params), now);
    simplified.add(now);
    if (proxy.triangles.size() > params.faces) thin_rest(proxy, enclosed, params, simplified);
  }
  tighten_regions(proxy, enclosed, tightening_of(params), tightened);
}

/// Tightening on the way: it finds a finer balance.
TightenCounts tighten_on_the_way(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params,
                                 const TightenParams& tightening) {
  TightenCounts counts;
  if (has_regions(proxy.triangles.size(), params)) {
    tighten_regions_on(proxy, enclosed, tightening, counts);
  } else {
    proxy = tighten(proxy, enclosed, tightening, counts);
  }
  return counts;
}

void tighten_early(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params,
                   SimplifyCounts& simplified) {
  if (params.limits == nullptr) {
    const TightenCounts counts = tighten_on_the_way(proxy, enclosed, params, one_sweep(params));
    if (counts.volume_before - counts.volume_after > kMuchRoom * std::abs(counts.volume_after)) {
      TightenParams few = one_sweep(params);
      few.sweeps = 3;
      few.final_sweeps = 2;
      tighten_on_the_way(proxy, enclosed, params, few);
    }
  } else {  // a surface of voxels may lie beyond the limits, and single steps within them would not lead there
    TightenParams early = tightening_of(params);  // relaxed, they let vertices move together
    early.sweeps = 1;
    early.final_sweeps = 2;
    early.least_gain = 5e-4;
    TightenCounts counts;
    params.limits->relax(true);
    proxy = tighten(proxy, enclosed, early, counts);
    params.limits->relax(false);
  }
  const double factor = by_volume(params) ? kLateFactor : 1;
  simplify_late(proxy, &enclosed, params, std::uint64_t(factor * double(params.faces)), simplified);
}

/// Faces and volume, or a volume inside that is lost, where a target is out of reach: a few faces less are not worth
/// spikes.
double price(const LatticeMesh& mesh, const TightenCounts& counts) {
  const double faces = double(mesh.triangles.size()), volume = counts.volume_after;
  return volume > 0 ? faces * volume : faces / std::max(-volume, 1.0);
}

/// Tight faces jam in a few places where growing goes on: the way there by growing alone, if it leads further, and to
/// the end or for a lower price.
void try_growing(const LatticeMesh& grown, LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params,
                 SimplifyCounts& simplified, TightenCounts& tightened, SimplifyCounts simplified_again) {
  LatticeMesh other = grown;
  simplify_late(other, nullptr, params, params.faces, simplified_again);
  if (other.triangles.size() >= proxy.triangles.size()) return;
  TightenCounts tightened_again;
  finish(other, enclosed, params, simplified_again, tightened_again);
  if (other.triangles.size() > params.faces && price(other, tightened_again) > price(proxy, tightened)) return;
  proxy = std::move(other);
  simplified = simplified_again;
  tightened = tightened_again;
}

SimplifyParams early_part_of(const SimplifyParams& params) {
  SimplifyParams early = params;
  early.faces = kEarlyFactor * params.faces;
  early.most_growth = kMostGrowth;
  early.strict_from = std::max(kEarlyStrict * params.faces, kEarlyStrictLeast);
  return early;
}

/// All that follows the growing collapses, of which `simplified` tells.
LatticeMesh tight_from(const LatticeMesh& grown, const Enclosed& enclosed, const SimplifyParams& params,
                       SimplifyCounts& simplified, TightenCounts& tightened) {
  tightened = {};
  if (grown.triangles.empty()) return grown;
  const SimplifyCounts simplified_early = simplified;
  LatticeMesh proxy = grown;
  if (params.faces > 0 || params.limits != nullptr) tighten_early(proxy, enclosed, params, simplified);
  finish(proxy, enclosed, params, simplified, tightened);
  if (by_volume(params) && proxy.triangles.size() > params.faces)
    try_growing(grown, proxy, enclosed, params, simplified, tightened, simplified_early);
  return proxy;
}

}  // namespace

TightenParams tightening_of(const SimplifyParams& params) {
  TightenParams tightening;
  static_cast<ShapeLimits&>(tightening) = params;
  tightening.faces_per_region = params.faces_per_region;
  if (params.limits != nullptr) {  // they refuse what vertices that move together take back only later
    tightening.sweeps = 0;
    tightening.final_sweeps = 10;
    tightening.least_gain = 1e-4;
  }
  return tightening;
}

LatticeMesh tight_proxy(const SurfaceSource& dense, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  const LatticeMesh grown = simplify(dense, early_part_of(params), simplified);
  return tight_from(grown, enclosed, params, simplified, tightened);
}

LatticeMesh tight_proxy(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  const LatticeMesh grown = simplify(mesh, early_part_of(params), simplified);
  LatticeMesh proxy = tight_from(grown, enclosed, params, simplified, tightened);
  proxy.provenance = mesh.provenance;
  return proxy;
}

}  // namespace bp
