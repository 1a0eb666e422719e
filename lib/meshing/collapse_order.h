#pragma once
#include "lib/meshing/collapse.h"

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

/// The strict order: least cost first, down to params().faces. Candidates are solved lazily, from a lower bound (the
/// unconstrained minimum of the summed quadrics), not eagerly for the two-ring as in [CB17]. The counts of `counts`
/// that tell why edges are left are set from the final state. Shells that others have swallowed are erased on the way
/// (shells.h). Needs a whole mesh: no vertex is locked.
StopReason collapse_strict(Collapser& collapser, SimplifyCounts& counts);

}  // namespace bp
