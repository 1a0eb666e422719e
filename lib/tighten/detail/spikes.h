#pragma once
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Cuts off vertices of three faces, where that lowers the volume. Such a vertex may stand far out with next to no
/// volume, and jams: a move inwards, or a collapse, would leave needles beside an edge. Returns how many were cut.
/// Deterministic. Cost: O(vertices), and three exact tests for a vertex of three faces.
std::uint64_t cut_spikes(ProxyEditor& editor);

}  // namespace bp
