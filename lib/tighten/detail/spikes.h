#pragma once
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Removes vertices that stand far out with almost no volume. The steps of voxels leave them on slanted sides, where
/// fits of the volume jam. There are two ways, each taken only where it lowers the volume of the proxy with a thin
/// skin:
///   falls  a vertex goes to the place of a neighbour
///   cuts   a vertex of three faces beside an edge is cut off; a fall would leave needles
/// Returns the number of removed vertices. Deterministic. Cost: O(vertices), and some exact tests for each that stands
/// out.
std::uint64_t drop_spikes(ProxyEditor& editor);

}  // namespace bp
