#pragma once
#include <functional>

#include "lib/meshing/proxy_editor.h"
#include "lib/meshing/simplify.h"

/// Collapses in order of the volume that each adds, its vertex put where that is least (fan_fit.h). Right for the last
/// part of a simplification, when the proxy lies close to what it encloses: volume is then what a lost vertex costs.
namespace bp {

/// Collapses edges of a tight proxy until `faces` are left or nothing can be collapsed. `settle`: tightens the editor's
/// mesh; called after each of several equal shares of the way but the last, because what a collapse costs is known only
/// of a tight proxy. Deterministic. Cost: some ten fits and two exact tests a collapse.
void thin(ProxyEditor& editor, std::uint64_t faces, const std::function<void()>& settle, SimplifyCounts& counts);

}  // namespace bp
