#pragma once
#include <functional>
#include <memory>

#include "lib/simplify/cost_order.h"
#include "lib/simplify/simplify.h"
#include "lib/tighten/proxy_editor.h"

/// Collapses in order of the volume that each adds, its vertex put where that is least (fan_fit.h). Right for the last
/// part of a simplification, when the proxy lies close to what it encloses: volume is then what a lost vertex costs.
namespace bp {

/// Collapses of an editor's mesh, cheapest first.
class ThinOrder : public CostOrder {
 public:
  /// To be called at the beginning, and after other changes of the mesh: all vertices may have moved, and edges
  /// flipped, so costs are estimates, and edges without one get another chance.
  virtual void renew() = 0;
  SimplifyCounts counts;  ///< collapses, fits and refusals
};

/// Keeps a reference. Deterministic. Cost: some ten fits and two exact tests a collapse.
[[nodiscard]] std::unique_ptr<ThinOrder> make_thin_order(ProxyEditor& editor);

/// How many faces are to be left after stage 1, 2... kThinStages of the way from one number of faces to another: equal
/// shares. Between stages the mesh is tightened, because what a collapse costs is known only of a tight proxy.
constexpr int kThinStages = 4;
[[nodiscard]] std::uint64_t faces_after(int stage, std::uint64_t from, std::uint64_t to);

/// Collapses edges of a tight proxy until `faces` are left or nothing can be collapsed. `settle`: tightens the editor's
/// mesh; called after each stage but the last. `first_stage`: those before it were done elsewhere.
[[nodiscard]] SimplifyCounts thin(ProxyEditor& editor, std::uint64_t faces, const std::function<void()>& settle,
                                  int first_stage = 1);

/// Collapses each edge that adds `most` or less, until none is left. Returns its work.
[[nodiscard]] SimplifyCounts thin_free(ProxyEditor& editor, double most);

}  // namespace bp
