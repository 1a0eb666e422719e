#pragma once
#include "lib/simplify/cost_order.h"
#include "lib/simplify/detail/collapse.h"

namespace bp {

constexpr std::uint64_t kBulkFactor = 8;  ///< the strict order begins at this many times the wanted faces

/// The strict order: least cost first. Candidates are solved lazily, from a lower bound (the unconstrained minimum of
/// the summed quadrics), not eagerly for the two-ring as in [CB17]. Shells that others have swallowed are erased on the
/// way (shells.h).
class StrictOrder : public CostOrder {
 public:
  explicit StrictOrder(Collapser& collapser);
  [[nodiscard]] std::uint64_t face_count() const override { return mesh_.face_count(); }
  void add_costs(std::vector<double>& costs) const override;
  bool run(double most, std::uint64_t enough) override;

  /// Sets the counts that tell why edges are left.
  void count(SimplifyCounts& counts) const;

 private:
  [[nodiscard]] bool is_edge(HalfEdgeId h) const { return mesh_.alive(HalfEdgeMesh::face(h)) && mesh_.edge(h) == h; }
  void push(HalfEdgeId h);
  void try_entry(const CostEntry& top, double most);
  void renew_around(VertexId u);

  Collapser& collapser_;
  HalfEdgeMesh& mesh_;
  std::vector<std::uint32_t> serial_;  // per half-edge: the one valid entry of its edge
  std::vector<Refusal> refusal_;       // per half-edge: why its edge must wait until its neighbourhood changes
  CostQueue queue_;
};

}  // namespace bp
