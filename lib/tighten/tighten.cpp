// Tightens by sweeps over all vertices, then all edges. If an enclosed thing blocks a vertex's best place, the fits
// learn of it: these are cutting planes with the exact test as the oracle.
#include "lib/tighten/tighten.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/exact/predicates.h"
#include "lib/mesh/shells.h"
#include "lib/tighten/detail/step_planner.h"
#include "lib/tighten/detail/thin_faces.h"
#include "lib/tighten/joint_fit.h"

namespace bp {

namespace {

constexpr std::size_t kMovesPerThread = 2, kFlipsPerThread = 64;
constexpr int kSweepsPerRefresh = 8;

class Tightener {
 public:
  Tightener(ProxyEditor& editor, const TightenParams& params, TightenCounts& counts)
      : editor_(editor),
        mesh_(editor.mesh()),
        params_(params),
        counts_(counts),
        joint_(mesh_, editor.contacts(), editor.forces()),
        waves_(editor.has_waves()),
        settles_(params.limits != nullptr),
        claims_(mesh_),
        planners_([&editor, &params] { return std::make_unique<StepPlanner>(editor, params.limits != nullptr); }),
        changed_at_(mesh_.vertex_capacity(), 1),
        stuck_at_(mesh_.vertex_capacity(), 0) {}

  void run() {
    const bool gains = sweep_while_it_gains(params_.sweeps, [this] { move_together(); });
    if (!gains && params_.stops_early) return;
    sweep_while_it_gains(params_.final_sweeps, [this] { move_each(); });
  }

 private:
  /// Returns false if the last sweep gained too little.
  template <class Move>
  bool sweep_while_it_gains(int most, const Move& move) {
    double last = volume_of(mesh_);
    const double least_gain = params_.least_gain * (params_.volume > 0 ? params_.volume : std::abs(last));
    for (int i = 0; i < most; ++i) {
      move();
      flip_edges();
      editor_.settle_points_of_many();
      if (++counts_.sweeps % kSweepsPerRefresh == 0) editor_.refresh();
      const double now = volume_of(mesh_);
      if (last - now < least_gain) return false;
      last = now;
    }
    return true;
  }

  /// Flips the edges of faces that have changed since the last call.
  void flip_edges() {
    const std::uint64_t since = flipped_at_;
    flipped_at_ = changes_;
    if (waves_) return flip_in_waves(since);
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (is_new_edge(h, since)) plan_and_make([&](StepPlanner& planner, StepPlan& plan) { planner.flip(h, plan); });
    }
    finish_run();
  }

  /// Flips edges in waves. Nearly all flips are refused, so all are planned at once; those that another flip was in the
  /// way of are planned again.
  void flip_in_waves(std::uint64_t since) {
    waiting_.clear();
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (is_new_edge(h, since)) waiting_.push_back(h);
    }
    while (!waiting_.empty()) {
      steps_.swap(waiting_);
      plan_all(kFlipsPerThread,
               [](StepPlanner& planner, std::size_t h, StepPlan& plan) { planner.flip(HalfEdgeId(h), plan); });
      make_flips();
    }
    finish_run();
  }

  void make_flips() {
    begin_wave();
    waiting_.clear();
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      if (!plans_[k].flips) continue;
      if (claims_.faces_are_free(HalfEdgeId(steps_[k])) && boxes_.add(plans_[k].boxes)) {
        claims_.claim();
        make(plans_[k]);
      } else {
        waiting_.push_back(steps_[k]);
      }
    }
  }

  [[nodiscard]] bool is_new_edge(HalfEdgeId h, std::uint64_t since) const {
    if (!mesh_.alive(HalfEdgeMesh::face(h)) || mesh_.edge(h) != h || mesh_.twin(h) == kNoId) return false;
    const std::array<VertexId, 4> corners = corners_of(h);
    return std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return changed_at_[v] > since; });
  }

  /// Moves all vertices by the joint fit. Vertices that go outwards are moved first, since the fit counts on the room
  /// that they make for others.
  void move_together() {
    joint_.solve();
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
    run(
        order_.size(), [&](std::size_t i) { return order_[i].second; }, always,
        [&](StepPlanner& planner, std::size_t i, StepPlan& plan) {
          const VertexId v = order_[i].second;
          planner.approach(v, joint_.shift(v), plan);
        });
    if (mesh_.volume6() > before) take_back();
  }

  /// Moves vertices back that made room which others could not use.
  void take_back() {
    run(
        went_out_.size(), [&](std::size_t i) { return went_out_[i].first; }, always,
        [&](StepPlanner& planner, std::size_t i, StepPlan& plan) {
          const auto& [v, p] = went_out_[i];
          planner.go_back(v, to_double(p - mesh_.position(v)), plan);
        });
  }

  /// Moves each vertex alone. One that could not move waits until its star has changed.
  void move_each() {
    alone_ = true;
    run(
        mesh_.vertex_capacity(), [](std::size_t v) { return VertexId(v); },
        [&](std::size_t v) { return is_free(VertexId(v)) && star_changed(VertexId(v)); },
        [](StepPlanner& planner, std::size_t v, StepPlan& plan) { planner.find_place(VertexId(v), plan); });
    alone_ = false;
  }

  static bool always(std::size_t) { return true; }

  /// Does the wanted steps among 0 to n - 1; step i is at vertex_of(i). A step is wanted if wants(i) and if its vertex
  /// is free. Without waves, plan(planner, i, plan) plans them one after the other. With waves, the steps of a wave do
  /// not touch each other's faces, and later ones wait.
  template <class VertexOf, class Wants, class Plan>
  void run(std::size_t n, const VertexOf& vertex_of, const Wants& wants, const Plan& plan) {
    if (!waves_) {
      for (std::size_t i = 0; i < n; ++i) {
        if (wants(i)) plan_and_make([&](StepPlanner& planner, StepPlan& p) { plan(planner, i, p); });
      }
      return finish_run();
    }
    waiting_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      if (is_free(vertex_of(i))) waiting_.push_back(i);
    }
    while (!waiting_.empty()) {
      choose(vertex_of, wants);
      plan_all(kMovesPerThread, plan);
      make_wave();
    }
    finish_run();
  }

  /// Moves the steps that the next wave can take from waiting_ to steps_, and drops those that are not wanted.
  template <class VertexOf, class Wants>
  void choose(const VertexOf& vertex_of, const Wants& wants) {
    begin_wave();
    steps_.clear();
    later_.clear();
    for (const std::size_t i : waiting_) {
      if (!claims_.star_is_free(vertex_of(i))) {
        later_.push_back(i);
      } else if (wants(i)) {
        claims_.claim();
        steps_.push_back(i);
      }
    }
    waiting_.swap(later_);
  }

  void begin_wave() {
    claims_.begin();
    boxes_.begin();
  }

  template <class Plan>
  void plan_all(std::size_t per_thread, const Plan& plan) {
    if (plans_.size() < steps_.size()) plans_.resize(steps_.size());
    planners_.for_each(steps_.size(), per_thread,
                       [&](StepPlanner& planner, std::size_t k) { plan(planner, steps_[k], plans_[k]); });
  }

  /// Makes the steps of a wave. A step that another one is in the way of waits for the next wave.
  void make_wave() {
    later_.clear();
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      if (plans_[k].changes_mesh() && !boxes_.add(plans_[k].boxes)) {
        later_.push_back(steps_[k]);
      } else {
        make(plans_[k]);
      }
    }
    if (alone_ || settles_) editor_.settle_points();
    const auto middle = std::ptrdiff_t(waiting_.size());
    waiting_.insert(waiting_.end(), later_.begin(), later_.end());
    std::inplace_merge(waiting_.begin(), waiting_.begin() + middle, waiting_.end());
  }

  template <class Plan>
  void plan_and_make(const Plan& plan) {
    plan(planners_.first(), plan_);
    make(plan_);
    if (alone_ || settles_) editor_.settle_points();
  }

  void finish_run() {
    planners_.visit([&](StepPlanner& planner) { planner.count(editor_); });
  }

  void make(const StepPlan& plan) {
    if (alone_) stuck_at_[plan.vertex] = changes_;
    plan.make(editor_);
    if (!plan.changes_mesh()) return;
    ++changes_;
    ++(plan.flips ? counts_.flips : counts_.moves);
    if (plan.flips) {
      for (const VertexId v : corners_of(plan.edge)) changed_at_[v] = changes_;
    } else {
      changed_at_[plan.vertex] = changes_;
    }
  }

  /// Returns the corners of the two faces beside the edge.
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
  bool alone_ = false;  // vertices move alone: they need contact points, and one that could not move waits
  const bool waves_;
  const bool settles_;  // contact points after each step, since limits must know where the last of them are listed
  WaveClaims claims_;
  WaveBoxes boxes_;
  WaveWorkers<StepPlanner> planners_;
  std::vector<std::size_t> waiting_, later_, steps_;  // numbers of steps; steps_: those of the wave
  std::vector<StepPlan> plans_;                       // for each step of the wave
  StepPlan plan_;
  std::vector<std::pair<double, VertexId>> order_;           // sorted by growth
  std::vector<std::pair<VertexId, LatticeCoord>> went_out_;  // each with its place before
  // Number of moves and flips made so far; that number at the last flips.
  std::uint64_t changes_ = 1, flipped_at_ = 0;
  // For each vertex: changes_ when it changed, and when it was tried.
  std::vector<std::uint64_t> changed_at_, stuck_at_;
};

}  // namespace

double volume_of(const HalfEdgeMesh& mesh) {
  return double(mesh.volume6()) / 6;
}

TightenCounts tighten_on(ProxyEditor& editor, const TightenParams& params) {
  TightenCounts counts;
  const std::uint64_t tries = editor.counts().tries;
  counts.volume_before = volume_of(editor.mesh());
  Tightener(editor, params, counts).run();
  counts.volume_after = volume_of(editor.mesh());
  if (params.most_of_flip > 0) {
    counts.flips += flip_thin_faces(editor, params.most_of_flip);
    counts.volume_of_flips = volume_of(editor.mesh()) - counts.volume_after;
    counts.volume_after += counts.volume_of_flips;
  }
  counts.tries = editor.counts().tries - tries;
  return counts;
}

LatticeMesh tighten(ProxyEditor& editor, const GridFrame& frame, const TightenParams& params, TightenCounts& counts) {
  HalfEdgeMesh before = editor.mesh();
  erase_inner_shells(before, editor.inwards(), &editor.sense());  // shells of collapses with the same editor
  counts = tighten_on(editor, params);
  editor.erase_inner_shells();
  counts.volume_before = volume_of(before);
  counts.volume_after = volume_of(editor.mesh());
  if (counts.volume_after - counts.volume_of_flips <= counts.volume_before) return editor.mesh().compact(frame);
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
