#pragma once
#include "lib/simplify/simplify.h"
#include "lib/tighten/tighten.h"

/// Makes a tight proxy of a given number of faces from the dense surface.
namespace bp {

/// Proxies of fewer faces come from one sequence (few_faces.h).
constexpr std::uint64_t kFewFaces = 64;

/// A proxy, and the counts of the work on it.
struct TightProxy {
  LatticeMesh mesh;
  SimplifyCounts simplified;
  TightenCounts tightened;
};

/// Makes a proxy from `dense`, a dense surface of repaired voxels, in five steps
/// (docs/decisions/0003-order-of-steps.md). Growing collapses lead to a few times the target. Then the proxy is
/// tightened, and further collapses only keep `enclosed` inside; they avoid growth that coarse faces could not lose
/// again. The result is in `frame`, which is the frame of `enclosed` and `params`. The voxels of `dense` are as large,
/// or 2, 4, 8 ... times larger. `halfway` receives the proxy at the moment when collapses by volume replaced collapses
/// by error: coarser proxies may begin from it. Null: not needed.
[[nodiscard]] TightProxy tight_proxy(const SurfaceSource& dense, const GridFrame& frame, const Enclosed& enclosed,
                                     const SimplifyParams& params, LatticeMesh* halfway = nullptr);
[[nodiscard]] inline TightProxy tight_proxy(const SurfaceSource& dense, const Enclosed& enclosed,
                                            const SimplifyParams& params) {
  return tight_proxy(dense, dense.frame(), enclosed, params);
}

/// Makes a proxy in the same way from a mesh; params.dense tells whether it is dense.
[[nodiscard]] TightProxy tight_proxy(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params,
                                     LatticeMesh* halfway = nullptr);

/// Returns the parameters of the last tightening of a proxy made with `params`.
[[nodiscard]] TightenParams tightening_of(const SimplifyParams& params);

/// Returns the parameters of the first step: growing collapses to some times the wanted faces, with a limit on the
/// growth of each.
[[nodiscard]] SimplifyParams growing_part_of(const SimplifyParams& params);

}  // namespace bp
