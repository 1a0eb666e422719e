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

/// Room for a proxy of `faces` triangles around a surface. The plane of a face does not know how far the surface
/// reaches: where thin parts end, steps that enclose least volume draw spikes. So no vertex leaves the surface's box by
/// more than a fiftieth of its extents, 5 of them over the number of faces, and a voxel; an icosahedron around a ball,
/// of 20 faces, takes an eighth of an extent. Everywhere for fewer faces than a box has, which may need all of it to
/// exist, and where no number is wanted (0): errors bound that.
[[nodiscard]] LatticeBox room_around(const LatticeBox& surface, std::uint64_t faces);

}  // namespace bp
