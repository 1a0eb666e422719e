#pragma once
#include "lib/simplify/simplify.h"
#include "lib/tighten/tighten.h"

/// From the dense surface to a tight proxy of a given number of faces.
namespace bp {

/// Proxies of fewer faces come from one sequence (few_faces.h).
constexpr std::uint64_t kFewFaces = 64;

/// A proxy, and what led to it.
struct TightProxy {
  LatticeMesh mesh;
  SimplifyCounts simplified;
  TightenCounts tightened;
};

/// `dense`: a dense surface of repaired voxels. Growing collapses to a few times the target, tightening, then collapses
/// that only keep `enclosed` inside, tightening again: growth that a coarse face could not take back is never made
/// (docs/decisions/0003-order-of-steps.md). The result is in `frame`, the one of `enclosed` and `params`. The voxels of
/// `dense` are as large, or 2, 4, 8 ... times larger. `halfway` receives what was left when collapses by error had
/// ended, and those by volume began: coarser proxies may begin from it. Null: nobody asks.
[[nodiscard]] TightProxy tight_proxy(const SurfaceSource& dense, const GridFrame& frame, const Enclosed& enclosed,
                                     const SimplifyParams& params, LatticeMesh* halfway = nullptr);
[[nodiscard]] inline TightProxy tight_proxy(const SurfaceSource& dense, const Enclosed& enclosed,
                                            const SimplifyParams& params) {
  return tight_proxy(dense, dense.frame(), enclosed, params);
}

/// The same from a mesh, dense or not as params.dense tells.
[[nodiscard]] TightProxy tight_proxy(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params,
                                     LatticeMesh* halfway = nullptr);

/// How a proxy made with `params` is tightened in the end.
[[nodiscard]] TightenParams tightening_of(const SimplifyParams& params);

/// Its first step: growing collapses to some times the faces wanted, with a limit on the growth of each.
[[nodiscard]] SimplifyParams growing_part_of(const SimplifyParams& params);

}  // namespace bp
