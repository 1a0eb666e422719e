#include "lib/tighten/tight_proxy.h"

#include <algorithm>
#include <cmath>

#include "lib/mesh/step_limits.h"
#include "lib/simplify/collapse_regions.h"
#include "lib/tighten/detail/spikes.h"
#include "lib/tighten/detail/thin.h"
#include "lib/tighten/detail/tighten_regions.h"

namespace bp {

namespace {

// The steps (1) to (5) and their numbers are those of docs/decisions/0003-order-of-steps.md, which says what was
// measured. Numbers of faces are multiples of the wanted number.
constexpr std::uint64_t kGrownTo = 6;  // step (1) ends there
// Step (1) is in strict order from this many faces on, or from kStrictLeast if that is more.
constexpr std::uint64_t kStrictFrom = 16, kStrictLeast = 10000;
constexpr double kPauseAt = 3;  // step (2) ends there
// Step (3) ends there; the second one is for regions and for few faces.
constexpr double kByErrorTo = 1.25, kByErrorToOfFew = 1.5;
// Steps (1) to (3): the most that one collapse may add, in a face's shares of the volume.
constexpr double kMostGrowth = 6;
constexpr std::uint64_t kWhole = 16;  // step (4): up to so many regions are worked on as one mesh
// Step (4): the most rounds of a sweep and collapses, if collapses jam above the target.
constexpr int kJamRounds = 4;
constexpr std::uint64_t kSmall = 512;  // faces: smaller proxies get another sweep in (2), and grow on if they jam
// Step (5): in volumes over faces squared; a collapse on a ball adds 7 on average.
constexpr double kNeedless = 2;

/// Returns whether edges are collapsed by volume, which knows neither errors nor limits.
bool by_volume(const SimplifyParams& params) {
  return params.faces > 0 && params.error_vox <= 0 && params.limits == nullptr;
}

bool is_above_target(const LatticeMesh& proxy, const SimplifyParams& params) {
  return by_volume(params) && proxy.triangles.size() > params.faces;
}

/// Returns the parameters with the volume that one flip of a thin face's edge may add: about three times what a
/// collapse adds on a ball, and at most a small share. None for few faces, since each of these proxies begins from one
/// of more (few_faces.h).
TightenParams with_flips(TightenParams params, double volume, std::uint64_t faces) {
  constexpr double kThreeCollapses = 20, kMostShare = 1e-4;
  if (faces < kFewFaces) return params;
  params.most_of_flip = std::abs(volume) * std::min(kThreeCollapses / (double(faces) * double(faces)), kMostShare);
  return params;
}
TightenParams with_flips(TightenParams params, const HalfEdgeMesh& proxy) {
  return with_flips(std::move(params), volume_of(proxy), proxy.face_count());
}
TightenParams with_flips(TightenParams params, const LatticeMesh& proxy) {
  return with_flips(std::move(params), double(volume6_of(proxy)) / 6, proxy.triangles.size());
}

/// Does steps (2) to (5) on a grown proxy.
class Steps {
 public:
  Steps(TightProxy grown, const Enclosed& enclosed, const SimplifyParams& params)
      : proxy_(std::move(grown)), enclosed_(enclosed), params_(params) {}

  /// halfway: as in tight_proxy().
  TightProxy run(LatticeMesh* halfway) {
    if (params_.limits != nullptr) {
      relax();
    } else if (params_.faces > 0) {
      collapse_by_error(kPauseAt);
      pause();
    }
    if (params_.faces > 0 || params_.limits != nullptr) collapse_by_error(by_error_to());
    if (halfway != nullptr && by_volume(params_)) *halfway = proxy_.mesh;
    return finish();
  }

  /// Does steps (4) and (5).
  TightProxy finish() {
    const bool many =
        has_regions(faces(), params_) && (faces() > kWhole * params_.faces_per_region || !is_above_target());
    if (many && is_above_target()) thin_regions();
    if (!many || is_above_target()) {
      HalfEdgeMesh mesh(proxy_.mesh);
      ProxyEditor editor(mesh, enclosed_, params_);
      if (is_above_target()) collapse_by_volume(editor);
      if (by_volume(params_) && !many && mesh.face_count() <= params_.faces) drop_needless(editor);
      if (!has_regions(mesh.face_count(), params_)) return tightened_whole(editor);
      put_back(editor);
    }
    // Each region has an editor of its own.
    tighten_regions(proxy_.mesh, enclosed_, with_flips(tightening_of(params_), proxy_.mesh), proxy_.tightened);
    return std::move(proxy_);
  }

 private:
  [[nodiscard]] std::uint64_t faces() const { return proxy_.mesh.triangles.size(); }
  [[nodiscard]] bool is_above_target() const { return bp::is_above_target(proxy_.mesh, params_); }
  [[nodiscard]] TightenParams sweeps(int together, int alone, double least_gain = TightenParams().least_gain) const {
    TightenParams some = tightening_of(params_);
    some.sweeps = together;
    some.final_sweeps = alone;
    some.least_gain = least_gain;
    return some;
  }
  [[nodiscard]] TightenParams one_sweep() const { return sweeps(1, 0, 0); }

  /// Returns where step (3) ends, as a multiple of the target. In regions fewer edges can collapse by volume, and a
  /// proxy of few faces would keep needless ones, so it ends later for them.
  [[nodiscard]] double by_error_to() const {
    if (!by_volume(params_)) return 1;
    const bool whole = kByErrorTo * double(params_.faces) <= double(kWhole * params_.faces_per_region);
    return whole && params_.faces >= kFewFaces ? kByErrorTo : kByErrorToOfFew;
  }

  /// Does step (2) under limits. A surface of voxels may lie beyond the limits, and single steps within them would not
  /// lead back. The limits are relaxed here, so vertices may move together.
  void relax() {
    TightenCounts ignored;
    params_.limits->relax(true);
    proxy_.mesh = tighten(proxy_.mesh, enclosed_, sweeps(1, 2), ignored);
    params_.limits->relax(false);
  }

  /// Does the pause of step (2), which removes much of the growth when half of the grown faces are left. It sweeps on
  /// while a sweep gains at least 2 %.
  void pause() {
    TightenParams some = sweeps(3, faces() < kSmall ? 2 : 1, 0.02);
    some.stops_early = true;
    TightenCounts ignored;
    if (has_regions(faces(), params_)) {
      tighten_regions_on(proxy_.mesh, enclosed_, some, ignored);
    } else {
      proxy_.mesh = tighten(proxy_.mesh, enclosed_, some, ignored);
    }
  }

  /// Does the collapses of steps (2) and (3). If collapses are refused because of the reach, they go on with a longer
  /// one.
  void collapse_by_error(double factor) {
    SimplifyParams late = params_;
    late.faces = std::uint64_t(factor * double(params_.faces));
    late.dense = false;
    late.enclosed = &enclosed_;
    late.most_growth = kMostGrowth;
    for (;; late.reach = loosened(late.reach, params_.reach)) {
      if (late.reach > 0) enclosed_.expect_near(late.reach);
      SimplifyCounts now;
      proxy_.mesh = simplify(proxy_.mesh, late, now);
      proxy_.simplified.add(now);
      if (late.reach <= 0 || now.stop == StopReason::faces || now.refused[Refusal::growth] == 0) return;
    }
  }

  /// Does step (4) on the regions of a large proxy.
  void thin_regions() {
    SimplifyCounts now;
    bp::thin_regions(proxy_.mesh, enclosed_, params_.faces, one_sweep(), now);
    proxy_.simplified.add(now);
  }

  /// Does step (4) on one mesh. If collapses jam, sweeps and collapses take turns, as long as they may reach the target
  /// at the pace of the last turn.
  void collapse_by_volume(ProxyEditor& editor) {
    const auto settle = [&] { tighten_on(editor, one_sweep()); };
    proxy_.simplified.add(thin(editor, params_.faces, settle));
    for (int round = 1; round <= kJamRounds && editor.mesh().face_count() > params_.faces; ++round) {
      settle();
      const SimplifyCounts now = thin(editor, params_.faces, settle, kThinStages);
      proxy_.simplified.add(now);
      const auto turns = std::uint64_t(kJamRounds - round);
      if (now.faces_out > params_.faces + turns * (now.faces_in - now.faces_out)) return;
    }
  }

  /// Does the first part of step (5): collapses that add almost nothing, in turns with sweeps while they leave clearly
  /// fewer faces. A flat side needs no vertex in its middle, and one that it has there sticks out.
  void drop_needless(ProxyEditor& editor) {
    const HalfEdgeMesh& mesh = editor.mesh();
    const std::uint64_t at_first = mesh.face_count();
    double before = 0;
    do {
      before = double(mesh.face_count());
      tighten_on(editor, one_sweep());
      const SimplifyCounts now = thin_free(editor, kNeedless * std::abs(volume_of(mesh)) / (before * before));
      proxy_.simplified.collapses += now.collapses + drop_spikes(editor);
      proxy_.simplified.solved += now.solved;
    } while (double(mesh.face_count()) <= kClearlyLess * before);
    if (mesh.face_count() == at_first) return;
    proxy_.simplified.faces_out = mesh.face_count();
    proxy_.simplified.stop = StopReason::least_volume;
  }

  /// Does the last part of step (5). Tightening regions ends earlier, since each region has a gain of its own.
  TightProxy tightened_whole(ProxyEditor& editor) {
    TightenParams last = tightening_of(params_);
    if (params_.limits == nullptr) last = enclosed_.is_exact() ? sweeps(10, 4, 1e-4) : sweeps(4, 2, 3e-4);
    proxy_.mesh = tighten(editor, proxy_.mesh.frame, with_flips(last, editor.mesh()), proxy_.tightened);
    return std::move(proxy_);
  }

  /// Ends the editing, and moves the editor's mesh into the proxy.
  void put_back(ProxyEditor& editor) {
    editor.erase_inner_shells();
    LatticeMesh out = editor.mesh().compact(proxy_.mesh.frame);
    proxy_.mesh.vertices = std::move(out.vertices);
    proxy_.mesh.triangles = std::move(out.triangles);
  }

  TightProxy proxy_;
  const Enclosed& enclosed_;
  const SimplifyParams& params_;
};

/// Returns the price of a proxy that cannot reach its target: faces times volume. For a proxy inside, it is faces over
/// volume. So spikes are not accepted for a few faces less.
double price(const TightProxy& proxy) {
  const double faces = double(proxy.mesh.triangles.size()), volume = proxy.tightened.volume_after;
  return volume > 0 ? faces * volume : faces / std::max(-volume, 1.0);
}

/// Does steps (2) to (5). A tight proxy of few faces may jam where growing could go on; then growing first and
/// tightening afterwards is tried, too. The second result is taken if it has fewer faces, and reaches the target or has
/// at most the same price.
TightProxy tight_from(const TightProxy& grown, const Enclosed& enclosed, const SimplifyParams& params,
                      LatticeMesh* halfway) {
  if (grown.mesh.triangles.empty()) return grown;
  TightProxy proxy = Steps(grown, enclosed, params).run(halfway);
  if (!is_above_target(proxy.mesh, params) || proxy.mesh.triangles.size() > kSmall) return proxy;
  TightProxy other = grown;
  SimplifyParams on = params;
  on.dense = false;
  SimplifyCounts counts;
  other.mesh = simplify(grown.mesh, on, counts);
  other.simplified.add(counts);
  if (other.mesh.triangles.size() >= proxy.mesh.triangles.size()) return proxy;
  other = Steps(std::move(other), enclosed, params).finish();
  return is_above_target(other.mesh, params) && price(other) > price(proxy) ? proxy : other;
}

/// Makes the proxy also with a half and a third of the surface's faces, and takes the one of least volume. If the
/// surface of the voxels has few faces for each wanted one, many faces of the proxy would remain steps of voxels, which
/// tightening cannot remove.
TightProxy least_from(const TightProxy& grown, const Enclosed& enclosed, const SimplifyParams& params,
                      LatticeMesh* halfway) {
  TightProxy proxy = tight_from(grown, enclosed, params, halfway);
  if (!by_volume(params)) return proxy;
  for (const std::uint64_t parts : {2, 3}) {
    SimplifyParams fewer = params;
    fewer.faces = grown.mesh.triangles.size() / parts;
    if (fewer.faces >= params.faces || fewer.faces < kFewFaces) continue;
    LatticeMesh halfway_of_other;
    TightProxy other = tight_from(grown, enclosed, fewer, halfway != nullptr ? &halfway_of_other : nullptr);
    if (other.tightened.volume_after >= proxy.tightened.volume_after) continue;
    if (halfway != nullptr) *halfway = std::move(halfway_of_other);
    other.simplified.stop = StopReason::least_volume;
    proxy = std::move(other);
  }
  return proxy;
}

/// Moves points from the lattice of a frame to that of another, whose voxels are a whole number of times smaller.
/// Exact.
class Refining {
 public:
  Refining(const GridFrame& coarse, const GridFrame& fine) : factor_(std::llround(coarse.voxel / fine.voxel)) {
    for (int i = 0; i < 3; ++i)
      shift_[i] = (coarse.origin[std::size_t(i)] * factor_ - fine.origin[std::size_t(i)]) * kLatticePerVoxel;
  }
  [[nodiscard]] LatticeCoord after(const LatticeCoord& p) const { return p * factor_ + shift_; }
  /// Returns the box of the points that after() moves into `box`.
  [[nodiscard]] LatticeBox before(LatticeBox box) const {
    for (int i = 0; i < 3; ++i) {
      box.min[i] = -floor_div(shift_[i] - box.min[i], factor_);
      box.max[i] = floor_div(box.max[i] - shift_[i], factor_);
    }
    return box;
  }

 private:
  std::int64_t factor_;
  LatticeCoord shift_;
};

}  // namespace

TightenParams tightening_of(const SimplifyParams& params) {
  TightenParams tightening;
  static_cast<ShapeLimits&>(tightening) = params;
  tightening.faces_per_region = params.faces_per_region;
  if (params.limits != nullptr) {  // limits refuse steps whose gain comes only later, as when vertices move together
    tightening.sweeps = 0;
    tightening.final_sweeps = 10;
    tightening.least_gain = 1e-4;
  }
  return tightening;
}

SimplifyParams growing_part_of(const SimplifyParams& params) {
  SimplifyParams early = params;
  early.faces = kGrownTo * params.faces;
  early.most_growth = kMostGrowth;
  early.strict_from = std::max(kStrictFrom * params.faces, kStrictLeast);
  return early;
}

TightProxy tight_proxy(const SurfaceSource& dense, const GridFrame& frame, const Enclosed& enclosed,
                       const SimplifyParams& params, LatticeMesh* halfway) {
  const Refining refining(dense.frame(), frame);
  SimplifyParams growing = growing_part_of(params);
  growing.room = refining.before(params.room);
  TightProxy grown;
  grown.mesh = simplify(dense, growing, grown.simplified);
  grown.mesh.frame = frame;
  for (LatticeCoord& p : grown.mesh.vertices) p = refining.after(p);
  return least_from(grown, enclosed, params, halfway);
}

TightProxy tight_proxy(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params,
                       LatticeMesh* halfway) {
  TightProxy grown;
  grown.mesh = simplify(mesh, growing_part_of(params), grown.simplified);
  TightProxy proxy = tight_from(grown, enclosed, params, halfway);
  proxy.mesh.provenance = mesh.provenance;
  return proxy;
}

}  // namespace bp
