#include "lib/tighten/tight_proxy.h"

#include <algorithm>
#include <cmath>

#include "lib/simplify/collapse_regions.h"
#include "lib/tighten/detail/spikes.h"
#include "lib/tighten/detail/thin.h"
#include "lib/tighten/detail/tighten_regions.h"

namespace bp {

namespace {

// The steps (1) to (5) and their numbers are those of docs/decisions/0003-order-of-steps.md, with what was measured.
// Numbers of faces are multiples of those wanted.
constexpr std::uint64_t kGrownTo = 6;                            // (1) ends there
constexpr std::uint64_t kStrictFrom = 16, kStrictLeast = 10000;  // (1) in strict order from there, and at least these
constexpr double kPauseAt = 3;                                   // (2) ends there
constexpr double kByErrorTo = 1.25, kByErrorToOfFew = 1.5;       // (3) ends there; in regions, and of few faces
constexpr double kMostGrowth = 6;      // (1) to (3), of one collapse: some times a face's share of the volume
constexpr std::uint64_t kWhole = 16;   // (4) up to so many regions are one mesh
constexpr int kJamRounds = 4;          // (4) of a sweep and collapses, where these jam above the target; at most
constexpr std::uint64_t kSmall = 512;  // faces: fewer are worth another sweep in (2), and growing on where they jam
constexpr double kNeedless = 2;        // (5) volumes over faces squared: a collapse around a ball adds 7 in the mean
constexpr double kFewDropped = 0.95;   // (5) times the faces: where more are left, the next round would drop few

/// Collapses by volume know neither errors nor limits.
bool by_volume(const SimplifyParams& params) {
  return params.faces > 0 && params.error_vox <= 0 && params.limits == nullptr;
}

bool is_above_target(const LatticeMesh& proxy, const SimplifyParams& params) {
  return by_volume(params) && proxy.triangles.size() > params.faces;
}

/// Steps (2) to (5), of a proxy on its way.
class Steps {
 public:
  Steps(TightProxy grown, const Enclosed& enclosed, const SimplifyParams& params)
      : proxy_(std::move(grown)), enclosed_(enclosed), params_(params) {}

  /// halfway: as tight_proxy() has it.
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

  /// Steps (4) and (5).
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
    tighten_regions(proxy_.mesh, enclosed_, tightening_of(params_), proxy_.tightened);  // each with its own editor
    return std::move(proxy_);
  }

 private:
  [[nodiscard]] std::uint64_t faces() const { return proxy_.mesh.triangles.size(); }
  [[nodiscard]] bool is_above_target() const { return bp::is_above_target(proxy_.mesh, params_); }
  [[nodiscard]] TightenParams sweeps(int together, int alone, double least_gain) const {
    TightenParams some = tightening_of(params_);
    some.sweeps = together;
    some.final_sweeps = alone;
    some.least_gain = least_gain;
    return some;
  }
  [[nodiscard]] TightenParams one_sweep() const { return sweeps(1, 0, 0); }

  /// (3) In regions fewer edges may collapse by volume, and an octahedron of a few faces keeps needless ones.
  [[nodiscard]] double by_error_to() const {
    if (!by_volume(params_)) return 1;
    const bool whole = kByErrorTo * double(params_.faces) <= double(kWhole * params_.faces_per_region);
    return whole && params_.faces >= kFewFaces ? kByErrorTo : kByErrorToOfFew;
  }

  /// (2) under limits. A surface of voxels may lie beyond them, and single steps within them would not lead back. They
  /// are relaxed here, so vertices may move together.
  void relax() {
    TightenCounts ignored;
    params_.limits->relax(true);
    proxy_.mesh = tighten(proxy_.mesh, enclosed_, sweeps(1, 2, 5e-4), ignored);
    params_.limits->relax(false);
  }

  /// (2) Much of the growth is left in the pause, and half of the faces. Sweeps that gain a fiftieth are worth others.
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

  /// (2), (3) Where faces jam by their reach, collapses go on with a longer one.
  void collapse_by_error(double factor) {
    SimplifyParams late = params_;
    late.faces = std::uint64_t(factor * double(params_.faces));
    late.dense = false;
    late.enclosed = &enclosed_;
    late.most_growth = kMostGrowth;
    for (;; late.reach = loosened(late.reach, params_.reach)) {
      SimplifyCounts now;
      proxy_.mesh = simplify(proxy_.mesh, late, now);
      proxy_.simplified.add(now);
      if (late.reach <= 0 || now.stop == StopReason::faces || now.refused[Refusal::growth] == 0) return;
    }
  }

  /// (4) On the regions of a large proxy.
  void thin_regions() {
    SimplifyCounts now;
    bp::thin_regions(proxy_.mesh, enclosed_, params_.faces, one_sweep(), now);
    proxy_.simplified.add(now);
  }

  /// (4) Where collapses jam, sweeps and collapses take turns, as long as they may reach the target at the pace of the
  /// last turn.
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

  /// (5) Collapses that add next to nothing, in turns with sweeps where there are many: what is flat needs no face in
  /// its middle, and one that it has there sticks out.
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
    } while (double(mesh.face_count()) <= kFewDropped * before);
    if (mesh.face_count() == at_first) return;
    proxy_.simplified.faces_out = mesh.face_count();
    proxy_.simplified.stop = StopReason::least_volume;
  }

  /// (5) The sweeps of regions, which have a gain each, end earlier.
  TightProxy tightened_whole(ProxyEditor& editor) {
    TightenParams last = tightening_of(params_);
    if (params_.limits == nullptr) last = enclosed_.is_exact() ? sweeps(10, 4, 1e-4) : sweeps(4, 2, 3e-4);
    proxy_.mesh = tighten(editor, proxy_.mesh.frame, last, proxy_.tightened);
    return std::move(proxy_);
  }

  /// The last step of an editor.
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

/// Faces and volume, or a volume inside that is lost, where a target is out of reach: a few faces less are not worth
/// spikes.
double price(const TightProxy& proxy) {
  const double faces = double(proxy.mesh.triangles.size()), volume = proxy.tightened.volume_after;
  return volume > 0 ? faces * volume : faces / std::max(-volume, 1.0);
}

/// All that follows (1). Few tight faces may jam where growing goes on. That way is taken if it leads further, and to
/// the end or for a lower price.
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

/// Where the surface of the voxels has few faces for each that is wanted, many of the proxy's may be steps of voxels,
/// which tightening does not take away. Half or a third of the surface's do, and are used if they leave less volume.
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

/// From the lattice of a frame to that of another, whose voxels are a whole number of times smaller. Exact.
class Refining {
 public:
  Refining(const GridFrame& coarse, const GridFrame& fine) : factor_(std::llround(coarse.voxel / fine.voxel)) {
    for (int i = 0; i < 3; ++i)
      shift_[i] = (coarse.origin[std::size_t(i)] * factor_ - fine.origin[std::size_t(i)]) * kLatticePerVoxel;
  }
  [[nodiscard]] LatticeCoord after(const LatticeCoord& p) const { return p * factor_ + shift_; }
  /// The points that come to lie within the box.
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
  if (params.limits != nullptr) {  // they refuse what vertices that move together take back only later
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
