#pragma once
#include "lib/check/check_report.h"
#include "lib/check/hiding_recipe.h"
#include "lib/core/indexed_mesh.h"

/// The exact verdict on a proxy. Shares nothing with the code that makes proxies but the predicates, so that it can
/// catch that code's mistakes. All yes/no answers are exact for the doubles as given; the measures are ordinary
/// floating point.
namespace bp {

/// How an occluder's file says that it was made.
struct HidingQuestion {
  HidingRecipe recipe;
  TriangleSource* walls = nullptr;  ///< the scene, perhaps without what can be seen through
  bool free_of_scene = false;       ///< asked only of a proxy that no triangle of the scene meets
};

struct CheckOptions {
  std::size_t max_examples = 5;          ///< kept per finding
  bool inside = false;                   ///< the proxy is to lie inside the scene, not around it; no distances then
  std::optional<HidingQuestion> hidden;  ///< with `inside`: asked if the proxy is not proven to be strictly inside
  bool convex = false;                   ///< the proxy is a union of convex parts (convex.h); no distances then
  double margin_world = 0;              ///< above 0: also asked is whether the proxy keeps this distance from the scene
  bool distances = true;                ///< sample distances between scene and proxy
  std::size_t distance_samples = 5000;  ///< triangles sampled on each side, at most
  std::uint64_t scene_memory_bytes = 512ull << 20;  ///< the scene is kept for distances only if it fits
};

/// Checks that `proxy` is a closed, oriented, embedded 2-manifold and, if `scene` is not null, that it strictly
/// encloses every triangle of the scene. Reads the scene once from its start (it is rewound), inside up to four times.
/// Memory: about 300 bytes per proxy triangle, plus scene_memory_bytes; it does not grow with the scene beyond that.
/// Time: linear in the scene, times log of the proxy. The result does not depend on the number of threads. Never throws
/// because of what the proxy is; passes on what the scene's reader throws.
[[nodiscard]] CheckReport check_proxy(const IndexedMesh& proxy, TriangleSource* scene,
                                      const CheckOptions& options = {});

}  // namespace bp
