#include "lib/tighten/tight_proxy.h"

#include <algorithm>
#include <cmath>

#include "lib/simplify/collapse_regions.h"
#include "lib/tighten/detail/spikes.h"
#include "lib/tighten/detail/thin.h"
#include "lib/tighten/detail/tighten_regions.h"
#include "lib/tighten/few_faces.h"

namespace bp {

namespace {

// Growing collapses turn to strict order at a multiple of the wanted faces; at least at so many: these are quick.
constexpr std::uint64_t kEarlyStrict = 16, kEarlyStrictLeast = 10000;
constexpr std::uint64_t kEarlyFactor = 6;  // of the wanted faces: where growing collapses end
constexpr double kMiddleFactor = 3;        // where collapses without growth pause for tightening
constexpr double kLateFactor = 1.25;       // where the order of collapses changes from quadric error to volume
constexpr double kEarlierFactor = 1.5;     // the same in regions, where fewer edges may collapse, and for few faces
constexpr std::uint64_t kFewForLate = 64;  // an octahedron of fewer keeps needless ones
constexpr double kMostGrowth = 6;          // of one collapse: some times a face's share of the volume
constexpr double kMuchRoom = 0.02;         // share of the volume: sweeps of the pause that gain more are worth others
constexpr int kJamRounds = 4;              // of a sweep and collapses, where these jam above the target; at most
constexpr std::uint64_t kGrown = 512;      // faces of a jam: among more, growing alone was never seen to lead further
constexpr std::uint64_t kWhole = 16;       // regions: up to so many faces are collapsed by volume as one mesh
constexpr double kNeedless = 2;            // volumes over faces squared: a collapse around a ball adds 7 in the mean
constexpr double kFewDropped = 0.95;       // times the faces: where more are left, the next round would drop few
constexpr int kNeedlessRounds = 8;

/// A proxy on the way, and what led to it.
struct Way {
  LatticeMesh proxy;
  SimplifyCounts simplified;
  TightenCounts tightened;
};

/// Collapses by volume know neither errors nor limits.
bool by_volume(const SimplifyParams& params) {
  return params.faces > 0 && params.error_vox <= 0 && params.limits == nullptr;
}

/// Whether collapses by volume have something to do.
bool is_above_target(const LatticeMesh& proxy, const SimplifyParams& params) {
  return by_volume(params) && proxy.triangles.size() > params.faces;
}

TightenParams one_sweep(const SimplifyParams& params) {
  TightenParams once = tightening_of(params);
  once.sweeps = 1;
  once.final_sweeps = 0;
  return once;
}

// --- The steps of docs/decisions/0003-order-of-steps.md, with its numbers ---

/// (2) In the pause. Much of the growth is left there, and half of the faces.
void tighten_middle(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params) {
  constexpr std::size_t kQuick = 512;  // faces: fewer are worth more sweeps
  TightenParams some = tightening_of(params);
  some.sweeps = 3;
  some.final_sweeps = proxy.triangles.size() < kQuick ? 2 : 1;
  some.least_gain = kMuchRoom;
  some.stops_early = true;
  TightenCounts counts;
  if (has_regions(proxy.triangles.size(), params)) {
    tighten_regions_on(proxy, enclosed, some, counts);
  } else {
    proxy = tighten(proxy, enclosed, some, counts);
  }
}

/// (2) under limits. A surface of voxels may lie beyond them, and single steps within them would not lead back. They
/// are relaxed here, so vertices may move together.
void tighten_to_limits(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params) {
  TightenParams early = tightening_of(params);
  early.sweeps = 1;
  early.final_sweeps = 2;
  early.least_gain = 5e-4;
  TightenCounts counts;
  params.limits->relax(true);
  proxy = tighten(proxy, enclosed, early, counts);
  params.limits->relax(false);
}

SimplifyCounts simplify_on(LatticeMesh& proxy, const SimplifyParams& params, SimplifyCounts& counts) {
  SimplifyCounts now;
  proxy = simplify(proxy, params, now);
  counts.add(now);
  return now;
}

/// (2), (3) In order of quadric error, to `factor` times the faces. Where faces jam by their reach, collapses go on
/// with a longer one.
void collapse_by_error(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params, double factor,
                       SimplifyCounts& counts) {
  SimplifyParams late = params;
  late.faces = std::uint64_t(factor * double(params.faces));
  late.dense = false;
  late.enclosed = &enclosed;
  late.most_growth = kMostGrowth;
  for (;; late.reach = loosened(late.reach, params.reach)) {
    const SimplifyCounts now = simplify_on(proxy, late, counts);
    if (late.reach <= 0 || now.stop == StopReason::faces || now.refused[Refusal::growth] == 0) return;
  }
}

double late_factor(const SimplifyParams& params) {
  if (!by_volume(params)) return 1;
  const bool whole = kLateFactor * double(params.faces) <= double(kWhole * params.faces_per_region);
  return whole && params.faces >= kFewForLate ? kLateFactor : kEarlierFactor;
}

/// The last step of an editor.
void put_back(ProxyEditor& editor, LatticeMesh& proxy) {
  editor.erase_inner_shells();
  LatticeMesh out = editor.mesh().compact(proxy.frame);
  proxy.vertices = std::move(out.vertices);
  proxy.triangles = std::move(out.triangles);
}

/// (4) What regions could not collapse, on one mesh.
void collapse_rest(LatticeMesh& proxy, const Enclosed& enclosed, const SimplifyParams& params, SimplifyCounts& counts) {
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, params);
  SimplifyCounts now;
  thin(
      editor, params.faces, [] {}, now, kThinStages);
  counts.add(now);
  put_back(editor, proxy);
}

/// (4), (5) In order of volume, then tightening, on the regions of a large proxy.
void finish_regions(Way& way, const Enclosed& enclosed, const SimplifyParams& params) {
  if (is_above_target(way.proxy, params)) {
    SimplifyCounts now;
    thin_regions(way.proxy, enclosed, params.faces, one_sweep(params), now);
    way.simplified.add(now);
    if (is_above_target(way.proxy, params)) collapse_rest(way.proxy, enclosed, params, way.simplified);
  }
  tighten_regions(way.proxy, enclosed, tightening_of(params), way.tightened);
}

/// (4) Where collapses jam, sweeps and collapses take turns, as long as they may reach the target at the pace of the
/// last turn.
void thin_whole(ProxyEditor& editor, const SimplifyParams& params, SimplifyCounts& counts) {
  SimplifyCounts now;
  TightenCounts ignored;
  const auto settle = [&] { tighten_on(editor, one_sweep(params), ignored); };
  thin(editor, params.faces, settle, now);
  counts.add(now);
  for (int round = 0; round < kJamRounds && editor.mesh().face_count() > params.faces; ++round) {
    settle();
    thin(
        editor, params.faces, [] {}, now, kThinStages);
    counts.add(now);
    const std::uint64_t left = editor.mesh().face_count(), turns = std::uint64_t(kJamRounds - 1 - round);
    if (left > params.faces + turns * (now.faces_in - now.faces_out)) return;
  }
}

/// (5) Collapses that add next to nothing, in turns with sweeps where there are many: what is flat needs no face in its
/// middle, and one that it has there sticks out.
void drop_needless(ProxyEditor& editor, const SimplifyParams& params, SimplifyCounts& counts) {
  const HalfEdgeMesh& mesh = editor.mesh();
  const std::uint64_t faces = mesh.face_count();
  for (int round = 0; round < kNeedlessRounds; ++round) {
    const std::uint64_t before = mesh.face_count();
    TightenCounts ignored;
    tighten_on(editor, one_sweep(params), ignored);
    SimplifyCounts now;
    thin_free(editor, kNeedless * std::abs(volume_of(mesh)) / std::pow(double(before), 2), now);
    counts.collapses += now.collapses + drop_spikes(editor);
    counts.solved += now.solved;
    if (double(mesh.face_count()) > kFewDropped * double(before)) break;
  }
  if (mesh.face_count() == faces) return;
  counts.faces_out = mesh.face_count();
  counts.stop = StopReason::least_volume;
}

/// (5) Of one mesh. The sweeps of regions, which have a gain each, end earlier.
TightenParams last_sweeps(const Enclosed& enclosed, const SimplifyParams& params) {
  TightenParams last = tightening_of(params);
  if (params.limits != nullptr) return last;
  const bool exact = enclosed.is_exact();
  last.sweeps = exact ? 10 : 4;
  last.final_sweeps = exact ? 4 : 2;
  last.least_gain = exact ? 1e-4 : 3e-4;
  return last;
}

/// (4), (5) The same on one mesh, by one editor: what it learns in (4) it knows in (5). Many faces are tightened by
/// regions all the same: that is faster, and next to as tight.
void finish_whole(Way& way, const Enclosed& enclosed, const SimplifyParams& params) {
  {
    HalfEdgeMesh mesh(way.proxy);
    ProxyEditor editor(mesh, enclosed, params);
    if (is_above_target(way.proxy, params)) thin_whole(editor, params, way.simplified);
    if (by_volume(params) && mesh.face_count() <= params.faces) drop_needless(editor, params, way.simplified);
    if (!has_regions(mesh.face_count(), params)) {
      way.proxy = tighten(editor, way.proxy.frame, last_sweeps(enclosed, params), way.tightened);
      return;
    }
    put_back(editor, way.proxy);
  }  // regions have editors of their own
  tighten_regions(way.proxy, enclosed, tightening_of(params), way.tightened);
}

void finish(Way& way, const Enclosed& enclosed, const SimplifyParams& params) {
  const std::uint64_t faces = way.proxy.triangles.size(), most = kWhole * params.faces_per_region;
  if (has_regions(faces, params) && (faces > most || !is_above_target(way.proxy, params))) {
    finish_regions(way, enclosed, params);
  } else {
    finish_whole(way, enclosed, params);
  }
}

/// From (1) to the target by growing alone.
void grow_on(LatticeMesh& proxy, const SimplifyParams& params, SimplifyCounts& counts) {
  SimplifyParams late = params;
  late.dense = false;
  late.enclosed = nullptr;
  late.most_growth = 0;
  simplify_on(proxy, late, counts);
}

/// Faces and volume, or a volume inside that is lost, where a target is out of reach: a few faces less are not worth
/// spikes.
double price(const Way& way) {
  const double faces = double(way.proxy.triangles.size()), volume = way.tightened.volume_after;
  return volume > 0 ? faces * volume : faces / std::max(-volume, 1.0);
}

/// Few tight faces may jam where growing goes on. That way is taken if it leads further, and to the end or for a lower
/// price.
void try_growing(Way other, Way& way, const Enclosed& enclosed, const SimplifyParams& params) {
  grow_on(other.proxy, params, other.simplified);
  if (other.proxy.triangles.size() >= way.proxy.triangles.size()) return;
  finish(other, enclosed, params);
  if (is_above_target(other.proxy, params) && price(other) > price(way)) return;
  way = std::move(other);
}

// --- Their order ---

/// All that follows (1).
Way tight_from(const Way& grown, const Enclosed& enclosed, const SimplifyParams& params) {
  if (grown.proxy.triangles.empty()) return grown;
  Way way = grown;
  if (params.limits != nullptr) {
    tighten_to_limits(way.proxy, enclosed, params);
  } else if (params.faces > 0) {
    collapse_by_error(way.proxy, enclosed, params, kMiddleFactor, way.simplified);
    tighten_middle(way.proxy, enclosed, params);
  }
  if (params.faces > 0 || params.limits != nullptr)
    collapse_by_error(way.proxy, enclosed, params, late_factor(params), way.simplified);
  finish(way, enclosed, params);
  if (is_above_target(way.proxy, params) && way.proxy.triangles.size() <= kGrown)
    try_growing(grown, way, enclosed, params);
  return way;
}

/// Where the surface of the voxels has few faces for each that is wanted, many of the proxy's may be steps of voxels,
/// which tightening does not take away. Half or a third of the surface's do, and are used if they leave less volume.
Way least_from(const Way& grown, const Enclosed& enclosed, const SimplifyParams& params) {
  Way way = tight_from(grown, enclosed, params);
  if (!by_volume(params)) return way;
  for (const std::uint64_t parts : {2, 3}) {
    SimplifyParams fewer = params;
    fewer.faces = grown.proxy.triangles.size() / parts;
    if (fewer.faces >= params.faces || fewer.faces < kFewFaces) continue;
    Way other = tight_from(grown, enclosed, fewer);
    if (other.tightened.volume_after >= way.tightened.volume_after) continue;
    other.simplified.stop = StopReason::least_volume;
    way = std::move(other);
  }
  return way;
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

LatticeMesh take(Way&& way, SimplifyCounts& simplified, TightenCounts& tightened) {
  simplified = std::move(way.simplified);
  tightened = way.tightened;
  return std::move(way.proxy);
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

SimplifyParams growing_part_of(const SimplifyParams& params) {
  SimplifyParams early = params;
  early.faces = kEarlyFactor * params.faces;
  early.most_growth = kMostGrowth;
  early.strict_from = std::max(kEarlyStrict * params.faces, kEarlyStrictLeast);
  return early;
}

LatticeMesh tight_proxy(const SurfaceSource& dense, const GridFrame& frame, const Enclosed& enclosed,
                        const SimplifyParams& params, SimplifyCounts& simplified, TightenCounts& tightened) {
  const Refining refining(dense.frame(), frame);
  SimplifyParams growing = growing_part_of(params);
  growing.room = refining.before(params.room);
  Way grown;
  grown.proxy = simplify(dense, growing, grown.simplified);
  grown.proxy.frame = frame;
  for (LatticeCoord& p : grown.proxy.vertices) p = refining.after(p);
  return take(least_from(grown, enclosed, params), simplified, tightened);
}

LatticeMesh tight_proxy(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params,
                        SimplifyCounts& simplified, TightenCounts& tightened) {
  Way grown;
  grown.proxy = simplify(mesh, growing_part_of(params), grown.simplified);
  LatticeMesh proxy = take(tight_from(grown, enclosed, params), simplified, tightened);
  proxy.provenance = mesh.provenance;
  return proxy;
}

}  // namespace bp
