// Sweeps over all vertices, then all edges. Where something that must stay inside blocks a vertex's best place, the
// fits learn of it: cutting planes with the exact test as the oracle.
#include "lib/tighten/tighten.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/mesh/shells.h"
#include "lib/tighten/detail/joint_fit.h"
#include "lib/tighten/detail/step_planner.h"
#include "lib/tighten/detail/steps_ahead.h"

namespace bp {

namespace {

constexpr double kJointReach = 0.25;  // of the mean spoke: how far a vertex may move at once with its neighbours
constexpr std::size_t kVerticesPerPlan = 128;  // with fewer, steps are in each other's way
constexpr std::size_t kPlansPerThread = 2;
constexpr int kSweepsPerRefresh = 8;

double volume_of(const HalfEdgeMesh& mesh) {
  return double(mesh.volume6()) / 6;
}

/// Regions have their threads already, and limits count steps one by one.
std::size_t plans_at_once(const ProxyEditor& editor, const TightenParams& params) {
  const HalfEdgeMesh& mesh = editor.mesh();
  if (thread_count() == 1 || params.limits != nullptr || !mesh.cell().holds(kEverywhere)) return 1;
  return std::clamp<std::size_t>(mesh.face_count() / 2 / kVerticesPerPlan, 1,
                                 kPlansPerThread * std::size_t(thread_count()));
}

class Tightener {
 public:
  Tightener(ProxyEditor& editor, const TightenParams& params, TightenCounts& counts)
      : editor_(editor),
        mesh_(editor.mesh()),
        params_(params),
        counts_(counts),
        joint_(mesh_, editor.contacts()),
        ahead_(plans_at_once(editor, params)),
        changed_at_(mesh_.vertex_capacity(), 1),
        stuck_at_(mesh_.vertex_capacity(), 0) {
    const auto new_planner = [&] { return std::make_unique<StepPlanner>(editor, params.limits != nullptr); };
    own_ = new_planner();
    for (std::size_t i = 0; i < ahead_.workers(); ++i) planners_.push_back(new_planner());
  }

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
    LatticeBox box;
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {  // a flip takes less than waking another thread
      if (!mesh_.alive(HalfEdgeMesh::face(h)) || mesh_.edge(h) != h || mesh_.twin(h) == kNoId) continue;
      const std::array<VertexId, 4> corners = corners_of(h);
      if (std::none_of(corners.begin(), corners.end(), [&](VertexId v) { return changed_at_[v] > since; })) continue;
      own_->flip(h);
      static_cast<void>(make(*own_, box));
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
    went_out_.clear();
    for (const auto& [growth, v] : order_) {
      if (growth > 0) went_out_.emplace_back(v, mesh_.position(v));
    }
    const int128 before = mesh_.volume6();
    run(order_.size(), always, [&](StepPlanner& planner, std::size_t i) {
      const VertexId v = order_[i].second;
      planner.approach(v, joint_.shift(v));
    });
    if (mesh_.volume6() > before) take_back();
  }

  /// Some made room that the others could not take: back where they were.
  void take_back() {
    run(went_out_.size(), always, [&](StepPlanner& planner, std::size_t i) {
      const auto& [v, p] = went_out_[i];
      planner.go_back(v, to_double(p - mesh_.position(v)));
    });
  }

  /// A vertex that could not move waits until its star has changed.
  void move_each() {
    waits_ = true;
    run(
        mesh_.vertex_capacity(), [&](std::size_t v) { return is_free(VertexId(v)) && star_changed(VertexId(v)); },
        [](StepPlanner& planner, std::size_t v) { planner.find_place(VertexId(v)); });
    waits_ = false;
  }

  static bool always(std::size_t) { return true; }

  /// The steps that are wanted, each planned by plan(planner, i).
  template <class Wants, class Plan>
  void run(std::size_t n, const Wants& wants, const Plan& plan) {
    ahead_.run(
        n, wants,
        [&](std::size_t i, std::size_t worker) {
          plan(*planners_[worker], i);
          return planners_[worker]->seen();
        },
        [&](std::size_t worker, LatticeBox& box) { return make(*planners_[worker], box); },
        [&](std::size_t i, LatticeBox& box) {
          if (!wants(i)) return false;
          plan(*own_, i);
          return make(*own_, box);
        });
  }

  bool make(StepPlanner& planner, LatticeBox& box) {
    const bool flip = planner.edge() != kNoId;
    if (waits_) stuck_at_[planner.vertex()] = changes_;
    const bool changed = planner.make(editor_, box);
    if (!planner.changes_mesh()) return changed;
    ++changes_;
    ++(flip ? counts_.flips : counts_.moves);
    if (!flip) {
      changed_at_[planner.vertex()] = changes_;
    } else {
      for (const VertexId v : corners_of(planner.edge())) changed_at_[v] = changes_;
    }
    return changed;
  }

  /// Of the two faces beside it.
  [[nodiscard]] std::array<VertexId, 4> corners_of(HalfEdgeId h) const {
    return {mesh_.from(h), mesh_.to(h), mesh_.opposite(h), mesh_.opposite(mesh_.twin(h))};
  }

  [[nodiscard]] bool is_free(VertexId v) const { return mesh_.vertex_alive(v) && !mesh_.locked(v); }

  [[nodiscard]] bool star_changed(VertexId v) const {
    bool changed = changed_at_[v] > stuck_at_[v];
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { changed = changed || changed_at_[mesh_.to(h)] > stuck_at_[v]; });
    return changed;
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  const TightenParams& params_;
  TightenCounts& counts_;
  JointFit joint_;
  bool waits_ = false;  // a vertex that could not move, until its star has changed
  StepsAhead ahead_;
  std::vector<std::unique_ptr<StepPlanner>> planners_;  // a worker's each
  std::unique_ptr<StepPlanner> own_;
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
