#pragma once
#include <cstdint>

#include "lib/mesh/edge_limit.h"
#include "lib/mesh/step_limits.h"

namespace bp {

/// What every step of simplification and tightening keeps beside the guarantee.
struct ShapeLimits {
  EdgeLimit edge_limit;          ///< of every edge that a step makes, the paper's c * S; empty: none
  StepLimits* limits = nullptr;  ///< null: none
  /// How far from what must stay inside, where that is given, a step may take a face, lattice units; 0: no matter how
  /// far. Where faces jam, it is loosened. A collapse that keeps nothing inside (SimplifyParams::free) leaves neither
  /// end of its edge farther behind, either.
  double reach = 0;
  static constexpr double kLoosened = 1.25;   ///< each time
  static constexpr double kMostLoosened = 8;  ///< times as far; then there is no bound
  LatticeBox room = kEverywhere;              ///< where vertices may be moved to: strictly inside
};

/// The next reach where this one was too short; 0: none.
[[nodiscard]] double loosened(double reach, double first);

/// Room for a proxy of `faces` triangles around a surface. The plane of a face does not know how far the surface
/// reaches: where thin parts end, steps that enclose least volume draw spikes. So no vertex leaves the surface's box by
/// more than a fiftieth of its extents, 5 of them over the number of faces, and a voxel; an icosahedron around a ball,
/// of 20 faces, takes an eighth of an extent. Everywhere for fewer faces than a box has (kLeastFacesWithRoom), which
/// may need all of it to exist, and where no number is wanted (0): errors bound that.
[[nodiscard]] LatticeBox room_around(const LatticeBox& surface, std::uint64_t faces);
constexpr std::uint64_t kFacesOfBox = 12, kLeastFacesWithRoom = kFacesOfBox;

}  // namespace bp
