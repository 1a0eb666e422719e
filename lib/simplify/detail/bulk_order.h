#pragma once
#include <span>

#include "lib/simplify/detail/collapse.h"

namespace bp {

/// Bounds on the cost of a collapse, lattice units^4, for the first and the last sweep.
struct BulkRange {
  double first, last;
};
constexpr double kFirstBound = 0.01 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel *
                               kLatticePerVoxel;  ///< 0.1 voxel off, over a voxel face
constexpr double kLastBound = 1e300;

/// The bulk of the collapses: sweeps over all edges take each collapse below a bound, and the bound grows when a sweep
/// takes little. Each vertex merges at most once a sweep, so that regions shrink evenly. There is no queue, and about
/// one quadratic program per collapse: several times as fast as the strict order, which is needed for the last part
/// only.
class BulkOrder {
 public:
  explicit BulkOrder(Collapser& collapser);
  [[nodiscard]] std::uint64_t face_count() const { return mesh_.face_count(); }
  /// Does one sweep; ends early at `enough` faces. Returns the number of collapses.
  std::uint64_t sweep(double bound, std::uint64_t enough);
  /// After a sweep that took nothing: returns false if no larger bound would let a sweep take anything.
  [[nodiscard]] bool some_wait() const { return some_wait_; }

 private:
  bool try_edge(HalfEdgeId h, double bound);
  bool wait(HalfEdgeId h);
  void reconsider_around(VertexId u);

  Collapser& collapser_;
  HalfEdgeMesh& mesh_;
  CollapsePlanner planner_;
  CollapsePlan plan_;
  std::vector<FaceId> faces_;             // faces to sweep over
  std::vector<float> worth_;              // per edge: the bound below which trying it again is in vain
  std::vector<std::uint32_t> merged_in_;  // per vertex: the sweep in which it last merged
  std::uint32_t sweep_ = 0;
  bool some_wait_ = false;  // some edge waits for a larger bound
};

/// Sweeps over the parts of a surface, in parallel, with one bound for all, until they have `enough` faces together or
/// fewer, or until a sweep with the last bound takes little. A part may take all that is left to take in one sweep, so
/// 3 to 30 % fewer faces were seen. Near the end the bound stays as long as some part finds its share within it. The
/// result does not depend on the threads.
void collapse_bulk(std::span<BulkOrder* const> parts, BulkRange range, std::uint64_t enough);

/// Sweeps over a surface as a whole.
void collapse_bulk(Collapser& collapser, BulkRange range, std::uint64_t enough);

}  // namespace bp
