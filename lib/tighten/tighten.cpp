// Sweeps over all vertices, then all edges. Where something that must stay inside blocks a vertex's best place, the
// fits learn of it: cutting planes with the exact test as the oracle.
#include "lib/tighten/tighten.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/mesh/shells.h"
#include "lib/tighten/detail/joint_fit.h"
#include "lib/tighten/fan_fit.h"

namespace bp {

namespace {

constexpr double kReach = 0.5;        // of the mean spoke: how far a vertex may move at once, alone
constexpr double kJointReach = 0.25;  // and together with its neighbours
constexpr int kAvoidRounds = 4;
constexpr int kSweepsPerRefresh = 8;

double volume_of(const HalfEdgeMesh& mesh) {
  return double(mesh.volume6()) / 6;
}

class Tightener {
 public:
  Tightener(ProxyEditor& editor, const TightenParams& params, TightenCounts& counts)
      : editor_(editor),
        mesh_(editor.mesh()),
        params_(params),
        counts_(counts),
        joint_(mesh_, editor.contacts()),
        changed_at_(mesh_.vertex_capacity(), 1),
        stuck_at_(mesh_.vertex_capacity(), 0) {}

  void run() {
    sweep_while_it_gains(params_.sweeps, [this] { move_together(); });
    sweep_while_it_gains(params_.final_sweeps, [this] { move_each(); });
  }

 private:
  template <class Move>
  void sweep_while_it_gains(int most, const Move& move) {
    double last = volume_of(mesh_);
    const double least_gain = params_.least_gain * (params_.volume > 0 ? params_.volume : std::abs(last));
    for (int i = 0; i < most; ++i) {
      move();
      flip_edges();
      if (++counts_.sweeps % kSweepsPerRefresh == 0) editor_.refresh();
      const double now = volume_of(mesh_);
      if (last - now < least_gain) break;
      last = now;
    }
  }

  /// Those of faces that have changed since the last time.
  void flip_edges() {
    const std::uint64_t since = flipped_at_;
    flipped_at_ = changes_;
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (!mesh_.alive(HalfEdgeMesh::face(h)) || mesh_.edge(h) != h || mesh_.twin(h) == kNoId) continue;
      const std::array<VertexId, 4> corners = {mesh_.from(h), mesh_.to(h), mesh_.opposite(h),
                                               mesh_.opposite(mesh_.twin(h))};
      if (std::none_of(corners.begin(), corners.end(), [&](VertexId v) { return changed_at_[v] > since; })) continue;
      if (!editor_.is_convex(h) || !editor_.flip(h)) continue;
      ++counts_.flips;
      ++changes_;
      for (const VertexId v : corners) changed_at_[v] = changes_;
    }
  }

  /// Those that go outwards first: the others then have the room that the joint fit counts on.
  void move_together() {
    joint_.solve(kJointReach);
    order_.clear();
    for (VertexId v = 0; v < mesh_.vertex_capacity(); ++v) {
      if (is_free(v)) order_.emplace_back(joint_.growth(v), v);
    }
    std::sort(order_.begin(), order_.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    const int128 before = mesh_.volume6();
    went_out_.clear();
    for (const auto& [growth, v] : order_) {
      if (growth > 0) went_out_.emplace_back(v, mesh_.position(v));
      approach(v, joint_.shift(v));
    }
    if (mesh_.volume6() > before) take_back();
  }

  /// Some made room that the others could not take: back where they were.
  void take_back() {
    for (const auto& [v, p] : went_out_) {
      gather_rim(v);
      const Vec3d x = to_double(p - mesh_.position(v));
      if (fit_.close() && worth_trying(x)) static_cast<void>(try_move(v, x));
    }
  }

  /// What is in the way becomes contact points for the next joint fit; this time the vertex goes a part of its way.
  void approach(VertexId v, const Vec3d& x) {
    if (rounded(x) == LatticeCoord{} || try_move(v, x)) return;
    if (editor_.blocker() != nullptr) {
      gather_rim(v);
      if (fit_.close() && fit_.avoid(x, *editor_.blocker(), place_of(v))) editor_.learn(v, fit_.obstacles());
    }
    if (!try_move(v, 0.5 * x)) try_move(v, 0.25 * x);
  }

  /// A vertex that could not move waits until its star has changed.
  void move_each() {
    for (VertexId v = 0; v < mesh_.vertex_capacity(); ++v) {
      if (!is_free(v) || !star_changed(v)) continue;
      stuck_at_[v] = changes_;
      move_vertex(v);
    }
  }

  [[nodiscard]] bool is_free(VertexId v) const { return mesh_.vertex_alive(v) && !mesh_.locked(v); }

  [[nodiscard]] bool star_changed(VertexId v) const {
    bool changed = changed_at_[v] > stuck_at_[v];
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { changed = changed || changed_at_[mesh_.to(h)] > stuck_at_[v]; });
    return changed;
  }

  void move_vertex(VertexId v) {
    const double reach = kReach * gather_rim(v);
    if (!fit_.close()) return;
    gather_points(v);
    for (int round = 0;; ++round) {
      const std::optional<Vec3d> x = fit_.least_volume({}, reach);
      if (!x || !worth_trying(*x) || try_move(v, *x)) return;
      if (round < kAvoidRounds && editor_.blocker() != nullptr && fit_.avoid(*x, *editor_.blocker(), place_of(v))) {
        editor_.learn(v, fit_.obstacles());
        continue;
      }
      shorten(v, *x, reach);
      return;
    }
  }

  /// Less of the way; and where limits may mind a step aside, straight inwards.
  void shorten(VertexId v, const Vec3d& x, double reach) {
    for (double share = 0.5; share > 0.1 && worth_trying(share * x); share /= 2) {
      if (try_move(v, share * x)) return;
    }
    if (params_.limits == nullptr) return;
    const Vec3d inwards = -reach * fit_.outward();
    for (double share = 0.5; share > 0.01 && worth_trying(share * inwards); share /= 2) {
      if (try_move(v, share * inwards)) return;
    }
  }

  [[nodiscard]] bool worth_trying(const Vec3d& x) const {
    const LatticeCoord d = rounded(x);
    return d != LatticeCoord{} && fit_.volume(to_double(d)) < 0;
  }
  bool try_move(VertexId v, const Vec3d& x) {
    const bool taken = editor_.move(v, mesh_.position(v) + rounded(x));
    counts_.moves += taken;
    if (taken) changed_at_[v] = ++changes_;
    return taken;
  }

  [[nodiscard]] Vec3d place_of(VertexId v) const { return to_double(mesh_.position(v) - editor_.contacts().origin()); }

  /// The star as a fan about the vertex; its mean spoke.
  double gather_rim(VertexId v) {
    const LatticeCoord p = mesh_.position(v);
    fit_.clear();
    double spokes = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const Vec3d a = to_double(mesh_.position(mesh_.to(h)) - p);
      fit_.add_rim(a);
      spokes += length(a);
    });
    return spokes / double(fit_.rim().size());
  }

  void gather_points(VertexId v) {
    const ContactPoints& contacts = editor_.contacts();
    const Vec3d shift = place_of(v);
    std::uint32_t sector = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      for (const std::uint32_t i : contacts.of(HalfEdgeMesh::face(h))) fit_.add_point(contacts[i] - shift, sector);
      ++sector;
    });
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  const TightenParams& params_;
  TightenCounts& counts_;
  FanFit fit_;
  JointFit joint_;
  std::vector<std::pair<double, VertexId>> order_;           // by growth
  std::vector<std::pair<VertexId, LatticeCoord>> went_out_;  // each with its place before
  std::uint64_t changes_ = 1, flipped_at_ = 0;               // moves and flips made so far; before the last flips
  std::vector<std::uint64_t> changed_at_, stuck_at_;  // per vertex: changes made when it changed, when it was tried
};

}  // namespace

void tighten_on(ProxyEditor& editor, const TightenParams& params, TightenCounts& counts) {
  counts = {};
  const std::uint64_t tries = editor.counts().tries;
  counts.volume_before = volume_of(editor.mesh());
  Tightener(editor, params, counts).run();
  counts.volume_after = volume_of(editor.mesh());
  counts.tries = editor.counts().tries - tries;
}

LatticeMesh tighten(ProxyEditor& editor, const GridFrame& frame, const TightenParams& params, TightenCounts& counts) {
  HalfEdgeMesh before = editor.mesh();
  erase_inner_shells(before, editor.inwards(), &editor.sense());  // those of collapses with the same editor
  tighten_on(editor, params, counts);
  editor.erase_inner_shells();
  counts.volume_before = volume_of(before);
  counts.volume_after = volume_of(editor.mesh());
  if (counts.volume_after <= counts.volume_before) return editor.mesh().compact(frame);
  counts.volume_after = counts.volume_before;
  return before.compact(frame);
}

LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                    TightenCounts& counts) {
  counts = {};
  if (proxy.triangles.empty()) return proxy;
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, params);
  LatticeMesh out = tighten(editor, proxy.frame, params, counts);
  out.provenance = proxy.provenance;
  return out;
}

}  // namespace bp
