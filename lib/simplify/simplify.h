#pragma once
#include <cstdint>
#include <string>

#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/simplify/refusal.h"
#include "lib/simplify/regions.h"
#include "lib/simplify/shape_limits.h"
#include "lib/surface/piece_store.h"
#include "lib/surface/surface.h"

/// Bounding simplification: quadric edge collapses [GH97] that grow the solid ([SGG00], [DLCW11]; [CB17] §3.4) or, if
/// an enclosed set is given, only keep that set inside. Each collapse is checked exactly, so the result encloses the
/// input surface, or the enclosed set, and does not intersect itself (docs/bounding.md).
namespace bp {

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

/// Simplifies the dense surface of repaired voxels: by cells, in parallel, down to a few times the wanted faces
/// (surface_tree.h), then in strict order. Deterministic, the same for every number of threads and every memory. Cost:
/// about n log n in its triangles. Throws out_of_resource if params.memory does not suffice, `failed` if the surface is
/// not closed and manifold or spans 2^29 lattice units.
[[nodiscard]] LatticeMesh simplify(const SurfaceSource& dense, const SimplifyParams& params, SimplifyCounts& counts);

/// Simplifies a mesh: with params.dense a dense_surface, else any mesh that is closed, oriented, 2-manifold and
/// embedded.
[[nodiscard]] LatticeMesh simplify(const LatticeMesh& mesh, const SimplifyParams& params, SimplifyCounts& counts);

/// Simplifies a mesh that is not dense and approximates other planes than its own: `quadrics`, per vertex and relative
/// to it.
[[nodiscard]] LatticeMesh simplify(const LatticeMesh& mesh, const std::vector<Quadric>& quadrics,
                                   const SimplifyParams& params, SimplifyCounts& counts);

}  // namespace bp
