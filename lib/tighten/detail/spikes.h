#pragma once
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Takes out vertices that stand far out with next to no volume, as the steps of voxels leave them on what is slanted.
/// Fits of the volume jam there.
///   falls  a vertex goes to the place of a neighbour
///   cuts   a vertex of three faces beside an edge is cut off; a fall would leave needles
/// Each where it lowers the volume of the proxy in a thin skin.
/// Returns how many vertices went. Deterministic. Cost: O(vertices), and some exact tests for each that stands out.
std::uint64_t drop_spikes(ProxyEditor& editor);

}  // namespace bp
