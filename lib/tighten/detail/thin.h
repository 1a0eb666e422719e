#pragma once
#include <functional>
#include <memory>

#include "lib/simplify/cost_order.h"
#include "lib/simplify/simplify.h"
#include "lib/tighten/proxy_editor.h"

/// Collapses edges in the order of the volume that each adds, and puts the merged vertex where that volume is least
/// (fan_fit.h). This suits the last part of a simplification, when the proxy lies close to what it encloses: there the
/// added volume is the true cost of a lost vertex.
namespace bp {

/// The collapses of an editor's mesh, cheapest first.
class ThinOrder : public CostOrder {
 public:
  /// Marks all costs as estimates and gives edges without a cost another chance. Call it at the beginning, and after
  /// any other change of the mesh, in which vertices may have moved and edges flipped.
  virtual void renew() = 0;
  SimplifyCounts counts;  ///< collapses, fits and refusals
};

/// Makes the order. Keeps a reference. Deterministic. Cost: about ten fits and two exact tests for each collapse.
[[nodiscard]] std::unique_ptr<ThinOrder> make_thin_order(ProxyEditor& editor);

/// Returns the number of faces to be left after stage 1, 2, ... kThinStages on the way from one number of faces to
/// another; stages are equal shares. The mesh is tightened between stages, because only a tight proxy shows what a
/// collapse costs.
constexpr int kThinStages = 4;
[[nodiscard]] std::uint64_t faces_after(int stage, std::uint64_t from, std::uint64_t to);

/// Collapses edges of a tight proxy until `faces` are left or nothing can be collapsed. `settle`: tightens the editor's
/// mesh; called after each stage but the last. `first_stage`: the stages before it are skipped.
[[nodiscard]] SimplifyCounts thin(ProxyEditor& editor, std::uint64_t faces, const std::function<void()>& settle,
                                  int first_stage = 1);

/// Collapses all edges that add at most `most` each. Returns the counts.
[[nodiscard]] SimplifyCounts thin_free(ProxyEditor& editor, double most);

}  // namespace bp
