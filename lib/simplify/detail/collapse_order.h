#pragma once
#include "lib/simplify/cost_wave.h"
#include "lib/simplify/detail/collapse.h"

namespace bp {

constexpr std::uint64_t kBulkFactor = 8;  ///< the strict order begins at this many times the wanted faces

/// The strict order: the cheapest collapse first. Costs are computed late, starting from a lower bound (the
/// unconstrained minimum of the summed quadrics), not at once for the two-ring as in [CB17]. Shells that others have
/// swallowed are erased on the way (shells.h). On a whole mesh, collapses are taken in waves (waves.h): edges that
/// leave each other alone, among the cheapest few percent, are planned on all threads and then taken in order.
class StrictOrder : public CostOrder {
 public:
  explicit StrictOrder(Collapser& collapser);
  [[nodiscard]] std::uint64_t face_count() const override { return mesh_.face_count(); }
  void add_costs(std::vector<double>& costs) const override;
  bool run(double most, std::uint64_t enough) override;

  /// Adds the counts that tell why the remaining edges were refused.
  void count(SimplifyCounts& counts) const;

 private:
  struct Renewal {
    HalfEdgeId edge;
    std::uint32_t serial;
  };
  [[nodiscard]] bool is_edge(HalfEdgeId h) const { return mesh_.alive(HalfEdgeMesh::face(h)) && mesh_.edge(h) == h; }
  void plan_wave(double next);
  void take_wave();
  void take(const CostEntry& entry, const CollapsePlan& plan);
  void renew(HalfEdgeId h);
  void renew_around(VertexId u);
  void push_renewed();

  Collapser& collapser_;
  HalfEdgeMesh& mesh_;
  WaveWorkers<CollapsePlanner> planners_;
  CostWave wave_;
  WaveBoxes boxes_;
  std::vector<std::uint32_t> serial_;  // per half-edge: number of the valid entry of its edge
  std::vector<Refusal> refusal_;       // per half-edge: why its edge waits until its neighbourhood changes
  CostQueue queue_;
  // Buffers of a wave.
  std::vector<CollapsePlan> plans_;  // of the members
  std::vector<Renewal> renewed_;     // edges whose cost has changed
  std::vector<double> costs_;        // their new costs
};

}  // namespace bp
