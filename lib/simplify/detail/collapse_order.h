#pragma once
#include "lib/simplify/cost_order.h"
#include "lib/simplify/detail/collapse.h"

/// In which order edges collapse.
namespace bp {

/// Bounds on the cost of a collapse, lattice units^4: those that sweeps begin and end with.
struct BulkRange {
  double first, last;
};
constexpr double kFirstBound = 0.01 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel *
                               kLatticePerVoxel;  ///< 0.1 voxel off, over a voxel face
constexpr double kLastBound = 1e300;

constexpr std::uint64_t kBulkFactor = 8;  ///< the strict order begins at this many times the wanted faces

/// Bulk: sweeps over all edges, taking what costs less than a bound, which grows when a sweep takes little; each vertex
/// merges at most once a sweep, so regions shrink evenly. No queue, and about one quadratic program per collapse:
/// several times as fast as the strict order, which only the last part needs. Ends at `enough` faces, or when a sweep
/// with the last bound takes little.
void collapse_bulk(Collapser& collapser, BulkRange range, std::uint64_t enough);

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
