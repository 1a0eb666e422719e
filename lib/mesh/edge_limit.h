#pragma once
#include <functional>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

/// True if an edge may run from a to b, or back: no longer than the limit anywhere along it. Empty: any edge may.
using EdgeLimit = std::function<bool(const LatticeCoord& a, const LatticeCoord& b)>;

/// The same limit everywhere, lattice units.
[[nodiscard]] inline EdgeLimit edges_up_to(double longest) {
  return [longest](const LatticeCoord& a, const LatticeCoord& b) { return length(to_double(b - a)) <= longest; };
}

}  // namespace bp
