#pragma once
#include <cstdint>

#include "lib/meshing/edge_limit.h"
#include "lib/meshing/step_limits.h"

namespace bp {

/// What every step of simplification and tightening keeps beside the guarantee.
struct ShapeLimits {
  EdgeLimit edge_limit;           ///< of every edge that a step makes, the paper's c * S; empty: none
  StepLimits* limits = nullptr;   ///< null: none
  LatticeBox room = kEverywhere;  ///< where vertices may be moved to: strictly inside
};

/// Room for a proxy of `faces` triangles (0: of many) around a surface. The plane of a face does not know how far the
/// surface reaches: where thin parts end, steps that enclose least volume draw spikes. So no vertex leaves the
/// surface's box by more than a small share of its extents, and by what few faces need around something round: 8
/// extents over their number (a tetrahedron around a ball reaches one extent beyond it, an icosahedron an eighth).
[[nodiscard]] LatticeBox room_around(const LatticeBox& surface, std::uint64_t faces);

}  // namespace bp
