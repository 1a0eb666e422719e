#pragma once
#include "lib/check/check_report.h"
#include "lib/check/hiding_recipe.h"
#include "lib/core/indexed_mesh.h"

/// Gives the exact verdict on a proxy. It shares only the predicates with the code that makes proxies, so that it can
/// catch that code's mistakes. All yes/no answers are exact for the doubles as given; the measures are ordinary
/// floating point.
namespace bp {

/// The question whether a proxy is hidden, as an occluder's file says that it was made. Where transparent triangles are
/// walls, too, it is asked only if no triangle of the scene meets the proxy.
struct HidingQuestion {
  HidingRecipe recipe;
  TriangleSource* walls = nullptr;  ///< the scene, perhaps without what can be seen through
};

struct CheckOptions {
  std::size_t max_examples = 5;  ///< examples kept for each finding, at most
  /// The proxy must lie inside the scene, not around it; then no distances are measured.
  bool inside = false;
  std::optional<HidingQuestion> hidden;  ///< with `inside`: asked if the proxy is not proven to be strictly inside
  /// The proxy must be a union of convex parts (convex.h); then no distances are measured.
  bool convex = false;
  double margin_world = 0;                          ///< the proxy must keep this distance from the scene; 0: not asked
  bool distances = true;                            ///< sample distances between scene and proxy
  std::size_t distance_samples = 5000;              ///< most triangles that are sampled on each side
  std::uint64_t scene_memory_bytes = 512ull << 20;  ///< the scene is kept for distances only if it fits
};

/// Checks that `proxy` is a closed, oriented, embedded 2-manifold and, if `scene` is not null, that it strictly
/// encloses every triangle of the scene. Reads the scene once from its start, which rewinds it; with `inside` up to
/// four times. Memory: about 300 bytes for each proxy triangle, plus scene_memory_bytes; it does not grow further with
/// the scene. Time: linear in the scene, times log of the proxy. The result does not depend on the number of threads. A
/// bad proxy never throws; errors of the scene's reader are passed on.
[[nodiscard]] CheckReport check_proxy(const IndexedMesh& proxy, TriangleSource* scene,
                                      const CheckOptions& options = {});

}  // namespace bp
