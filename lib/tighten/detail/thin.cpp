#include "lib/tighten/detail/thin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/vec3.h"
#include "lib/simplify/cost_wave.h"
#include "lib/tighten/fan_fit.h"

namespace bp {

namespace {

// Faces of small meshes have hundreds of contact points each, so that a single cost is worth another thread.
constexpr std::size_t kCostsPerThread = 8, kCostsOfFewPerThread = 1;

struct Candidate {
  Vec3d offset;  // from the position of from(h)
  double cost;   // volume added
};

/// A planned collapse of an edge.
struct ThinPlan {
  enum class Outcome { refused, too_dear, allowed };
  Outcome outcome = Outcome::refused;
  double cost = 0;  // if it is too dear: the cost, an estimate if `stale`
  bool stale = false;
  LatticeCoord to;  // if it is allowed: the new place of its vertex
  EditBoxes boxes;  // if it is allowed: the boxes of the new faces
};

/// The costs that decide whether a collapse waits. It waits if it costs more than its own entry and more than the next
/// one.
struct Turn {
  double own;   // the expected cost
  double next;  // cost of the cheapest collapse that waits; infinite if none waits
  double most;
};

/// Plans collapses without changing anything. Planners of one editor may work at the same time.
class ThinPlanner {
 public:
  explicit ThinPlanner(const ProxyEditor& editor) : editor_(editor), mesh_(editor.mesh()), check_(editor.new_check()) {}

  [[nodiscard]] std::optional<double> cost(HalfEdgeId h) {
    const std::optional<Candidate> c = solve(h);
    return c ? std::optional(c->cost) : std::nullopt;
  }

  /// Plans the collapse of h. `stale`: its expected cost is an estimate, which may be too low.
  void plan(HalfEdgeId h, bool stale, const Turn& turn, ThinPlan& plan) {
    plan.outcome = ThinPlan::Outcome::refused;
    plan.stale = stale;
    const std::optional<Candidate> candidate = solve(h);
    if (!candidate) return;
    const double next = std::min(std::isinf(turn.next) ? candidate->cost : turn.next, turn.most);
    if (stale && candidate->cost > std::max(turn.own, next)) {
      plan.outcome = ThinPlan::Outcome::too_dear;
      plan.cost = candidate->cost;
      plan.stale = false;
    } else {
      find_place(h, *candidate, std::max({turn.own, candidate->cost, next}), plan);
    }
  }

  /// Adds its counts to the editor's and to `counts`, and clears them.
  void count(ProxyEditor& editor, SimplifyCounts& counts) {
    counts.solved += counts_.solved;
    counts.refused += counts_.refused;
    counts.refused += check_.counts.refused;
    editor.add(check_.counts);
    counts_ = {};
    check_.counts = {};
  }

 private:
  /// Finds a place for the merged vertex where the collapse costs at most `most`.
  void find_place(HalfEdgeId h, Candidate c, double most, ThinPlan& plan) {
    const LatticeCoord p = mesh_.position(mesh_.from(h));
    const Vec3d shift = to_double(p - editor_.contacts().origin());
    const double before = fit_.volume(c.offset) - c.cost;
    const auto is_too_dear = [&](double cost) {
      if (cost <= most) return false;
      plan.outcome = ThinPlan::Outcome::too_dear;
      plan.cost = cost;
      return true;
    };
    for (int round = 0; round < kFanRounds; ++round) {
      if (try_at(h, p + rounded(c.offset), plan)) return;
      if (check_.blocker() == nullptr || !fit_.avoid(c.offset, *check_.blocker(), shift)) break;
      const auto x = fit_.least_volume(middle_, kFanReach * size_);
      if (!x) return;
      c = {*x, fit_.volume(*x) - before};
      if (is_too_dear(c.cost)) return;
    }
    for (const double lift : {0.004, 0.016, 0.064}) {
      const Vec3d x = c.offset + (lift * size_) * fit_.outward();
      if (is_too_dear(fit_.volume(x) - before) || try_at(h, p + rounded(x), plan)) return;
    }
  }

  bool try_at(HalfEdgeId h, const LatticeCoord& to, ThinPlan& plan) {
    if (!check_.allows_collapse(h, to)) return false;
    plan.outcome = ThinPlan::Outcome::allowed;
    plan.to = to;
    check_.put_boxes(plan.boxes);
    return true;
  }

  std::optional<Candidate> solve(HalfEdgeId h) {
    if (!mesh_.can_collapse(h)) {
      ++counts_.refused[Refusal::link];
      return std::nullopt;
    }
    ++counts_.solved;
    const double before = gather(h);
    if (!fit_.close()) return std::nullopt;
    const auto x = fit_.least_volume(middle_, kFanReach * size_);
    if (!x) {
      ++counts_.refused[Refusal::constraints];
      return std::nullopt;
    }
    return Candidate{*x, fit_.volume(*x) - before};
  }

  /// Sets the fit to the fan that would replace both stars. Returns the volume under them now.
  double gather(HalfEdgeId h) {
    const HalfEdgeId t = mesh_.twin(h);
    const LatticeCoord origin = mesh_.position(mesh_.from(h));
    const Vec3d w = to_double(mesh_.position(mesh_.to(h)) - origin);
    middle_ = 0.5 * w;
    size_ = 0;
    fit_.clear();
    double before = 0;  // the faces at from(h) add nothing, since it is the origin
    std::uint32_t sector = 0, sector_of_t = 0;
    for (const HalfEdgeId spoke : {h, t}) {
      if (spoke == t) sector_of_t = sector;
      for (HalfEdgeId g = mesh_.rotate(spoke); mesh_.rotate(g) != spoke; g = mesh_.rotate(g)) {
        const Vec3d a = to_double(mesh_.position(mesh_.to(g)) - origin);
        if (spoke == t) before += dot(w, cross(a, to_double(mesh_.position(mesh_.opposite(g)) - origin))) / 6;
        size_ += length(a - middle_);
        fit_.add_rim(a);
        add_points(HalfEdgeMesh::face(g), origin, sector++);
      }
    }
    size_ /= double(sector);
    // The faces that vanish lie under the spokes to their opposite corners.
    add_points(HalfEdgeMesh::face(h), origin, 0);
    add_points(HalfEdgeMesh::face(t), origin, sector_of_t);
    return before;
  }

  void add_points(FaceId f, const LatticeCoord& origin, std::uint32_t sector) {
    const Vec3d shift = to_double(origin - editor_.contacts().origin());
    for (const std::uint32_t i : editor_.contacts().of(f)) fit_.add_point(editor_.contacts()[i] - shift, sector);
  }

  const ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  EditCheck check_;
  SimplifyCounts counts_;
  FanFit fit_;
  Vec3d middle_{};   // of the edge solved last, relative to its start
  double size_ = 0;  // mean spoke of its fan
};

class Thinner final : public ThinOrder {
 public:
  explicit Thinner(ProxyEditor& editor)
      : editor_(editor),
        mesh_(editor.mesh()),
        planners_([&editor] { return std::make_unique<ThinPlanner>(editor); }),
        wave_(mesh_),
        serial_(3 * mesh_.face_capacity(), 0),
        stale_(3 * mesh_.face_capacity(), 0),
        queued_(3 * mesh_.face_capacity(), 0) {}

  void renew() override {
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (!is_edge(h)) continue;
      if (queued_[h]) {
        stale_[h] = 1;
      } else {
        renew(h);
      }
    }
    push_renewed();
    count();
  }

  [[nodiscard]] std::uint64_t face_count() const override { return mesh_.face_count(); }

  void add_costs(std::vector<double>& costs) const override {
    for (const CostEntry& entry : queue_.entries()) costs.push_back(entry.cost);
  }

  bool run(double most, std::uint64_t enough) override {
    bool some_left = true;
    while (some_left && mesh_.face_count() > enough) {
      const double next = wave_.choose(queue_, editor_.has_waves(), most, enough, [&](const CostEntry& e) {
        return is_edge(e.edge) && serial_[e.edge] == e.serial;
      });
      some_left = !wave_.members().empty();
      plan_wave(next, most);
      take_wave();
      push_renewed();
    }
    count();
    return some_left;
  }

 private:
  struct Renewal {
    HalfEdgeId edge;
    std::uint32_t serial;
  };
  [[nodiscard]] bool is_edge(HalfEdgeId h) const { return mesh_.alive(HalfEdgeMesh::face(h)) && mesh_.edge(h) == h; }

  void count() {
    planners_.visit([&](ThinPlanner& planner) { planner.count(editor_, counts); });
  }

  void plan_wave(double next, double most) {
    const std::vector<CostEntry>& members = wave_.members();
    if (plans_.size() < members.size()) plans_.resize(members.size());
    planners_.for_each(members.size(), 1, [&](ThinPlanner& planner, std::size_t i) {
      const auto [cost, edge, serial] = members[i];
      planner.plan(edge, stale_[edge] != 0, {cost, next, most}, plans_[i]);
    });
  }

  void take_wave() {
    const std::vector<CostEntry>& members = wave_.members();
    boxes_.begin();
    for (std::size_t i = 0; i < members.size(); ++i) {
      queued_[members[i].edge] = 0;
      take(members[i], plans_[i]);
    }
    editor_.settle_points();
  }

  void take(const CostEntry& entry, const ThinPlan& plan) {
    if (plan.outcome == ThinPlan::Outcome::refused) return;
    if (plan.outcome == ThinPlan::Outcome::too_dear) {
      stale_[entry.edge] = plan.stale;
      enqueue({plan.cost, entry.edge, entry.serial});
    } else if (!boxes_.add(plan.boxes)) {
      enqueue(entry);  // for the next wave
    } else {
      const VertexId u = mesh_.from(entry.edge);
      editor_.make_collapse(entry.edge, plan.to);
      ++counts.collapses;
      renew_around(u);
    }
  }

  void enqueue(const CostEntry& entry) {
    queue_.push(entry);
    queued_[entry.edge] = 1;
  }

  void renew(HalfEdgeId h) {
    const HalfEdgeId e = mesh_.edge(h);
    if (mesh_.locked(mesh_.from(e)) || mesh_.locked(mesh_.to(e))) return;
    stale_[e] = 0;
    queued_[e] = 0;
    renewed_.push_back({e, ++serial_[e]});
  }

  /// Makes new entries for the edges at u. The edges one step further out keep their entries as estimates.
  void renew_around(VertexId u) {
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
      renew(g);
      if (mesh_.locked(mesh_.to(g))) return;
      mesh_.for_each_outgoing(mesh_.to(g), [&](HalfEdgeId k) {
        if (mesh_.to(k) != u) stale_[mesh_.edge(k)] = 1;
      });
    });
  }

  void push_renewed() {
    costs_.resize(renewed_.size());
    const std::size_t per_thread = editor_.has_waves() ? kCostsPerThread : kCostsOfFewPerThread;
    const std::size_t grain = editor_.has_planners() ? per_thread : renewed_.size() + 1;
    planners_.for_each(renewed_.size(), grain,
                       [&](ThinPlanner& planner, std::size_t i) { costs_[i] = planner.cost(renewed_[i].edge); });
    for (std::size_t i = 0; i < renewed_.size(); ++i) {
      const auto [edge, serial] = renewed_[i];
      if (costs_[i]) enqueue({*costs_[i], edge, serial});
    }
    renewed_.clear();
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  WaveWorkers<ThinPlanner> planners_;
  CostWave wave_;
  WaveBoxes boxes_;
  std::vector<std::uint32_t> serial_;  // per half-edge: the one valid entry of its edge
  std::vector<char> stale_;            // its entry's cost is an estimate
  std::vector<char> queued_;           // it has a valid entry
  CostQueue queue_;
  // The next members belong to the present wave.
  std::vector<ThinPlan> plans_;               // for each member
  std::vector<Renewal> renewed_;              // edges whose cost has changed
  std::vector<std::optional<double>> costs_;  // for each renewed edge
};

}  // namespace

std::unique_ptr<ThinOrder> make_thin_order(ProxyEditor& editor) {
  return std::make_unique<Thinner>(editor);
}

std::uint64_t faces_after(int stage, std::uint64_t from, std::uint64_t to) {
  if (stage == kThinStages) return to;
  return std::uint64_t(double(from) * std::pow(double(to) / double(from), double(stage) / kThinStages));
}

SimplifyCounts thin(ProxyEditor& editor, std::uint64_t faces, const std::function<void()>& settle, int first_stage) {
  Thinner order(editor);
  const std::uint64_t faces_in = editor.mesh().face_count();
  bool enough = false;
  for (int stage = first_stage; stage <= kThinStages; ++stage) {
    order.renew();
    const std::uint64_t wanted = faces_after(stage, faces_in, faces);
    enough = order.run(std::numeric_limits<double>::infinity(), wanted);
    while (!enough && editor.loosen()) {
      order.renew();
      enough = order.run(std::numeric_limits<double>::infinity(), wanted);
    }
    if (stage < kThinStages) settle();
  }
  SimplifyCounts counts = order.counts;
  counts.faces_in = counts.faces_flat = faces_in;
  counts.faces_out = editor.mesh().face_count();
  counts.stop = enough ? StopReason::faces : counts.reason_left();
  return counts;
}

SimplifyCounts thin_free(ProxyEditor& editor, double most) {
  Thinner order(editor);
  order.renew();
  order.run(most, 0);
  return order.counts;
}

}  // namespace bp
