#pragma once
#include <cstdint>
#include <string>

#include "lib/simplify/refusal.h"
#include "lib/simplify/region_size.h"
#include "lib/simplify/shape_limits.h"
#include "lib/surface/piece_store.h"

/// The parameters of simplification, and its counts.
namespace bp {

class Enclosed;

struct SimplifyParams : ShapeLimits {
  std::uint64_t faces = 0;  ///< stop at this many triangles; 0: no target
  /// From this many triangles on a dense surface is simplified in strict order; above, in sweeps. 0: kBulkFactor
  /// (collapse_order.h) times `faces`.
  std::uint64_t strict_from = 0;
  double error_vox =
      0;  ///< stop when the next collapse's root mean square distance to its planes exceeds this; 0: no limit
  /// The input is a dense voxel surface: its flat regions are merged first, then sweeps take the bulk. False: strict
  /// order at once.
  bool dense = true;
  /// If given, a collapse need not grow the solid: it must only keep this set inside. Far tighter; slower per collapse.
  const Enclosed* enclosed = nullptr;
  /// Free collapses: they need neither grow the solid nor keep anything inside. They take the least error, and the
  /// surface stays embedded. `enclosed` then is the set that its faces stay near.
  bool free = false;
  /// The most that one collapse may add to the volume, as a multiple of the volume at the beginning over the number of
  /// faces left; 0: no limit. Quadrics do not care how far out planes meet, so spikes would grow where nothing else is
  /// left to collapse. Not for pieces of a dense surface, whose volume is not known.
  double most_growth = 0;
  /// For a region of a surface (regions.h): six times the volume of the whole, and the number of its faces outside of
  /// the region when it was cut.
  struct Whole {
    double volume6 = 0;
    std::uint64_t faces_elsewhere = 0;
  } whole;
  /// A surface of several times this many faces is cut into regions, which are worked on at the same time (regions.h).
  std::uint64_t faces_per_region = kFacesPerRegion;
  PieceMemory memory;  ///< for a surface that is simplified by cells; does not change the result
};

/// Why simplification ended: the target is reached, or no collapse is left that keeps the guarantee and the error, the
/// limits or the edge length. least_volume: further faces would save next to no volume, or add volume.
enum class StopReason { faces, error, limits, edge_length, least_volume, nothing_left };
[[nodiscard]] std::string to_string(StopReason reason);

struct SimplifyCounts {
  std::uint64_t faces_in = 0, faces_flat = 0, faces_out = 0;  ///< faces given, after merging flat regions, left
  std::uint64_t collapses = 0, solved = 0;                    ///< collapses taken; quadratic programs solved
  /// Why edges of the result were refused. In strict order: edges that were tried and cannot be merged, by the test
  /// that the best try failed. By volume (thin.h): refused tries, several for an edge included.
  Refusals refused;
  StopReason stop = StopReason::nothing_left;
  std::string limit;                            ///< if the limits stopped it: the limit that refused last
  void add(const SimplifyCounts& next);         ///< counts of a run that continued where this one ended
  void add_beside(const SimplifyCounts& part);  ///< work and refusals on another part of the same mesh
  /// Returns why no remaining edge was merged.
  [[nodiscard]] StopReason reason_left() const;
};

/// The end of the sweeps over the bulk of a surface.
struct BulkEnd {
  std::uint64_t faces = 0;  ///< number of faces to reach
  double cost = 0;          ///< largest cost of a collapse, lattice units^4; 0: no sweep is made
};

}  // namespace bp
