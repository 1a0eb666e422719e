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

/// Bounding simplification: quadric edge collapses [GH97] that grow the solid ([SGG00], [DLCW11]; [CB17] §3.4) or,
/// given what must stay inside, only keep that inside; each is checked exactly, so the result encloses the input
/// surface, or that, and does not intersect itself (docs/bounding.md).
namespace bp {

struct SimplifyParams : ShapeLimits {
  std::uint64_t faces = 0;  ///< stop at this many triangles; 0: no target
  /// A dense surface is in strict order only from this many triangles on: above, what is cheap goes first. 0: from
  /// kBulkFactor (collapse_order.h) times `faces`.
  std::uint64_t strict_from = 0;
  double error_vox =
      0;  ///< stop when the next collapse's root mean square distance to its planes exceeds this; 0: no limit
  /// The input is a dense voxel surface: its flat regions are merged first, then sweeps take the bulk. False: strict
  /// order at once.
  bool dense = true;
  /// If given, a collapse need not grow the solid: it must only keep this inside. Tighter by far; slower per collapse.
  const Enclosed* enclosed = nullptr;
  /// A collapse need neither grow the solid nor keep anything inside: it takes the least error, and stays embedded.
  /// `enclosed` is what its faces stay near, then.
  bool free = false;
  /// The most that one collapse may add to the volume, as a multiple of the volume at the beginning over the faces that
  /// are left; 0: no limit. Quadrics do not mind how far out planes meet: where nothing else is left to collapse,
  /// spikes would grow. Not for pieces of a dense surface, which do not know the volume.
  double most_growth = 0;
  /// Of a region of a surface (regions.h): six times the volume of all of it, and its faces elsewhere, as the region
  /// was cut.
  struct Whole {
    double volume6 = 0;
    std::uint64_t faces_elsewhere = 0;
  } whole;
  /// A surface of several times so many faces is cut into regions, which are worked on at the same time (regions.h).
  std::uint64_t faces_per_region = kFacesPerRegion;
  PieceMemory memory;  ///< of a surface that is simplified by cells; does not change the result
};

/// Why simplification ended: the target is reached, or no collapse is left that keeps the guarantee and, beside it, the
/// error, the limits or the edge length. least_volume: further faces would take next to nothing off the volume, or add
/// to it.
enum class StopReason { faces, error, limits, edge_length, least_volume, nothing_left };
[[nodiscard]] std::string to_string(StopReason reason);

struct SimplifyCounts {
  std::uint64_t faces_in = 0, faces_flat = 0, faces_out = 0;  ///< given, after merging flat regions, left
  std::uint64_t collapses = 0, solved = 0;                    ///< taken; quadratic programs solved
  /// In strict order: edges of the result that were tried and cannot be merged as it is, by the test that the best try
  /// failed. By volume (thin.h): tries refused, an edge's several included.
  Refusals refused;
  StopReason stop = StopReason::nothing_left;
  std::string limit;                            ///< if the limits stopped it: the one that refused last
  void add(const SimplifyCounts& next);         ///< of a run that took over where this one ended
  void add_beside(const SimplifyCounts& part);  ///< work and refusals on another part of the same mesh
  /// Why no edge that is left was merged.
  [[nodiscard]] StopReason reason_left() const;
};

/// A dense surface of repaired voxels, simplified by cells, in parallel, down to a few times the faces wanted
/// (surface_tree.h), then in strict order. Deterministic, the same for every number of threads and every memory. Cost:
/// about n log n in its triangles. Throws out_of_resource if params.memory does not suffice, `failed` if the surface is
/// not closed and manifold or spans 2^29 lattice units.
[[nodiscard]] LatticeMesh simplify(const SurfaceSource& dense, const SimplifyParams& params, SimplifyCounts& counts);

/// The same of a mesh: with params.dense a dense_surface, else any that is closed, oriented, 2-manifold and embedded.
[[nodiscard]] LatticeMesh simplify(const LatticeMesh& mesh, const SimplifyParams& params, SimplifyCounts& counts);

/// The same of a mesh that is not dense, which stands for other planes than its own: `quadrics`, per vertex and about
/// it.
[[nodiscard]] LatticeMesh simplify(const LatticeMesh& mesh, const std::vector<Quadric>& quadrics,
                                   const SimplifyParams& params, SimplifyCounts& counts);

}  // namespace bp
