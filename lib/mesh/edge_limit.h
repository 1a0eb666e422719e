#pragma once
#include <functional>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

/// Returns true if an edge may run between a and b: it is nowhere longer than the limit there. An empty function allows
/// any edge.
using EdgeLimit = std::function<bool(const LatticeCoord& a, const LatticeCoord& b)>;

/// Returns a limit that is the same everywhere, lattice units.
[[nodiscard]] inline EdgeLimit edges_up_to(double longest) {
  return [longest](const LatticeCoord& a, const LatticeCoord& b) { return length(to_double(b - a)) <= longest; };
}

}  // namespace bp
