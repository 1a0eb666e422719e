#include "lib/tighten/detail/thin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/vec3.h"
#include "lib/tighten/fan_fit.h"

namespace bp {

namespace {

constexpr double kReach = 0.5;  // of the mean spoke: how far the merged vertex may leave the edge's middle
constexpr int kAvoidRounds = 4;

struct Candidate {
  Vec3d offset;  // from the position of from(h)
  double cost;   // volume added
};

class Thinner final : public ThinOrder {
 public:
  Thinner(ProxyEditor& editor, SimplifyCounts& counts)
      : editor_(editor),
        mesh_(editor.mesh()),
        counts_(counts),
        serial_(3 * mesh_.face_capacity(), 0),
        stale_(3 * mesh_.face_capacity(), 0),
        queued_(3 * mesh_.face_capacity(), 0) {}

  void renew() override {
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (!mesh_.alive(HalfEdgeMesh::face(h)) || mesh_.edge(h) != h) continue;
      if (queued_[h]) {
        stale_[h] = 1;
      } else {
        push(h);
      }
    }
  }

  [[nodiscard]] std::uint64_t face_count() const override { return mesh_.face_count(); }

  void add_costs(std::vector<double>& costs) const override {
    for (const CostEntry& entry : queue_.entries()) costs.push_back(entry.cost);
  }

  bool run(double most, std::uint64_t enough) override {
    while (mesh_.face_count() > enough) {
      if (queue_.empty() || queue_.top().cost > most) return false;
      const CostEntry top = queue_.top();
      queue_.pop();
      const HalfEdgeId e = top.edge;
      if (!mesh_.alive(HalfEdgeMesh::face(e)) || mesh_.edge(e) != e || serial_[e] != top.serial) continue;
      queued_[e] = 0;
      const std::optional<Candidate> candidate = solve(e);
      if (!candidate) continue;
      const double next = std::min(queue_.empty() ? candidate->cost : queue_.top().cost, most);
      if (stale_[e] && candidate->cost > std::max(top.cost, next)) {
        stale_[e] = 0;
        enqueue({candidate->cost, e, top.serial});
        continue;
      }
      const VertexId u = mesh_.from(e);
      const double dearer = take(e, *candidate, std::max({top.cost, candidate->cost, next}));
      if (dearer > 0) enqueue({dearer, e, top.serial});
      if (dearer == 0) renew_around(u);
    }
    return true;
  }

 private:
  void push(HalfEdgeId h) {
    const HalfEdgeId e = mesh_.edge(h);
    if (mesh_.locked(mesh_.from(e)) || mesh_.locked(mesh_.to(e))) return;
    stale_[e] = 0;
    ++serial_[e];
    queued_[e] = 0;
    if (const auto c = solve(e)) enqueue({c->cost, e, serial_[e]});
  }

  void enqueue(const CostEntry& entry) {
    queue_.push(entry);
    queued_[entry.edge] = 1;
  }

  /// Collapses for at most `most`: 0 if done, the cost if it is dearer than that, negative if it cannot be.
  double take(HalfEdgeId h, Candidate c, double most) {
    const LatticeCoord p = mesh_.position(mesh_.from(h));
    const Vec3d shift = to_double(p - editor_.contacts().origin());
    const double before = fit_.volume(c.offset) - c.cost;
    for (int round = 0; round < kAvoidRounds; ++round) {
      if (try_at(h, p, c.offset)) return 0;
      if (editor_.blocker() == nullptr || !fit_.avoid(c.offset, *editor_.blocker(), shift)) break;
      const auto x = fit_.least_volume(middle_, kReach * size_);
      if (!x) return -1;
      c = {*x, fit_.volume(*x) - before};
      if (c.cost > most) return c.cost;
    }
    for (const double lift : {0.004, 0.016, 0.064}) {
      const Vec3d x = c.offset + (lift * size_) * fit_.outward();
      const double cost = fit_.volume(x) - before;
      if (cost > most) return cost;
      if (try_at(h, p, x)) return 0;
    }
    return -1;
  }

  bool try_at(HalfEdgeId h, const LatticeCoord& p, const Vec3d& x) {
    const Refusals before = editor_.counts().refused;
    const bool taken = editor_.collapse(h, p + rounded(x));
    counts_.collapses += taken;
    counts_.refused += editor_.counts().refused;
    counts_.refused -= before;
    return taken;
  }

  std::optional<Candidate> solve(HalfEdgeId h) {
    if (!mesh_.can_collapse(h)) {
      ++counts_.refused[Refusal::link];
      return std::nullopt;
    }
    ++counts_.solved;
    const double before = gather(h);
    if (!fit_.close()) return std::nullopt;
    const auto x = fit_.least_volume(middle_, kReach * size_);
    if (!x) {
      ++counts_.refused[Refusal::constraints];
      return std::nullopt;
    }
    return Candidate{*x, fit_.volume(*x) - before};
  }

  /// The fan that would replace both stars; the volume under them now.
  double gather(HalfEdgeId h) {
    const HalfEdgeId t = mesh_.twin(h);
    const LatticeCoord origin = mesh_.position(mesh_.from(h));
    const Vec3d w = to_double(mesh_.position(mesh_.to(h)) - origin);
    middle_ = 0.5 * w;
    size_ = 0;
    fit_.clear();
    double before = 0;  // the faces at from(h), the origin, add none
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
    add_points(HalfEdgeMesh::face(h), origin, 0);  // the faces that vanish lie under the spokes to their far corners
    add_points(HalfEdgeMesh::face(t), origin, sector_of_t);
    return before;
  }

  void add_points(FaceId f, const LatticeCoord& origin, std::uint32_t sector) {
    const Vec3d shift = to_double(origin - editor_.contacts().origin());
    for (const std::uint32_t i : editor_.contacts().of(f)) fit_.add_point(editor_.contacts()[i] - shift, sector);
  }

  /// New entries for the edges at u; those one step further out keep theirs as an estimate.
  void renew_around(VertexId u) {
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
      push(g);
      if (mesh_.locked(mesh_.to(g))) return;
      mesh_.for_each_outgoing(mesh_.to(g), [&](HalfEdgeId k) {
        if (mesh_.to(k) != u) stale_[mesh_.edge(k)] = 1;
      });
    });
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  SimplifyCounts& counts_;
  FanFit fit_;
  Vec3d middle_{};                     // of the edge solved last, from its start
  double size_ = 0;                    // mean spoke of its fan
  std::vector<std::uint32_t> serial_;  // per half-edge: the one valid entry of its edge
  std::vector<char> stale_;            // its entry's cost is an estimate
  std::vector<char> queued_;           // it has a valid entry
  CostQueue queue_;
};

}  // namespace

std::unique_ptr<ThinOrder> make_thin_order(ProxyEditor& editor, SimplifyCounts& counts) {
  return std::make_unique<Thinner>(editor, counts);
}

std::uint64_t faces_after(int stage, std::uint64_t from, std::uint64_t to) {
  if (stage == kThinStages) return to;
  return std::uint64_t(double(from) * std::pow(double(to) / double(from), double(stage) / kThinStages));
}

void thin(ProxyEditor& editor, std::uint64_t faces, const std::function<void()>& settle, SimplifyCounts& counts,
          int first_stage) {
  counts = {};
  counts.faces_in = counts.faces_flat = editor.mesh().face_count();
  Thinner order(editor, counts);
  bool enough = false;
  for (int stage = first_stage; stage <= kThinStages; ++stage) {
    order.renew();
    const std::uint64_t wanted = faces_after(stage, counts.faces_in, faces);
    enough = order.run(std::numeric_limits<double>::infinity(), wanted);
    while (!enough && editor.loosen()) {
      order.renew();
      enough = order.run(std::numeric_limits<double>::infinity(), wanted);
    }
    if (stage < kThinStages) settle();
  }
  counts.stop = enough ? StopReason::faces : counts.reason_left();
  counts.faces_out = editor.mesh().face_count();
}

}  // namespace bp
