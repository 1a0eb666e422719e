#pragma once
#include <span>

#include "lib/simplify/detail/collapse.h"

namespace bp {

/// Bounds on the cost of a collapse, lattice units^4: those that sweeps begin and end with.
struct BulkRange {
  double first, last;
};
constexpr double kFirstBound = 0.01 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel *
                               kLatticePerVoxel;  ///< 0.1 voxel off, over a voxel face
constexpr double kLastBound = 1e300;

/// Bulk: sweeps over all edges, taking what costs less than a bound, which grows when a sweep takes little; each vertex
/// merges at most once a sweep, so regions shrink evenly. No queue, and about one quadratic program per collapse:
/// several times as fast as the strict order, which only the last part needs.
class BulkOrder {
 public:
  explicit BulkOrder(Collapser& collapser);
  [[nodiscard]] std::uint64_t face_count() const { return mesh_.face_count(); }
  /// Ends early at `enough` faces. Returns the number of collapses.
  std::uint64_t sweep(double bound, std::uint64_t enough);
  /// Of the last sweep, if it took nothing: false if no larger bound lets a sweep take anything.
  [[nodiscard]] bool some_wait() const { return some_wait_; }

 private:
  bool try_edge(HalfEdgeId h, double bound);
  bool wait(HalfEdgeId h);
  void reconsider_around(VertexId u);

  Collapser& collapser_;
  HalfEdgeMesh& mesh_;
  CollapsePlanner planner_;
  CollapsePlan plan_;
  std::vector<FaceId> faces_;             // those to sweep over
  std::vector<float> worth_;              // per edge: below this bound no try is worth it
  std::vector<std::uint32_t> merged_in_;  // per vertex: sweep
  std::uint32_t sweep_ = 0;
  bool some_wait_ = false;  // for a larger bound
};

/// Sweeps over the parts of a surface, in parallel, with one bound for all: until they have `enough` faces together or
/// fewer (a part may take all that is left to take in one sweep: 3 to 30 % fewer were seen), or until a sweep with the
/// last bound takes little. Near the end the bound stays as long as a part finds its share of what is left to take. The
/// result does not depend on the threads.
void collapse_bulk(std::span<BulkOrder* const> parts, BulkRange range, std::uint64_t enough);

/// The same of a surface as a whole.
void collapse_bulk(Collapser& collapser, BulkRange range, std::uint64_t enough);

}  // namespace bp
