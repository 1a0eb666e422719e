#pragma once
#include <cstdint>

#include "lib/mesh/box_group.h"
#include "lib/mesh/edge_limit.h"

namespace bp {

class StepLimits;

/// A result is clearly less than another one, in faces or lengths, if it is below this share of it.
constexpr double kClearlyLess = 0.95;

/// Limits that every step of simplification and tightening keeps, in addition to enclosing.
struct ShapeLimits {
  EdgeLimit edge_limit;          ///< largest edge that a step may make, the paper's c * S; empty: no limit
  StepLimits* limits = nullptr;  ///< null: none
  /// The farthest, in lattice units, that a step may take a face from the enclosed set, if there is one; 0: no bound.
  /// It is loosened where nothing can be collapsed any more. A free collapse (SimplifyParams::free) also leaves neither
  /// end of its edge farther than this from the new faces.
  double reach = 0;
  static constexpr double kLoosened = 1.25;   ///< factor of each loosening
  static constexpr double kMostLoosened = 8;  ///< beyond this many times the first reach there is no bound
  LatticeBox room = kEverywhere;              ///< vertices may only be moved to places strictly inside this box
};

/// Returns the next reach if `reach` was too short; 0: no bound.
[[nodiscard]] double loosened(double reach, double first);

/// Returns the room for a proxy of `faces` triangles around a surface. The plane of a face does not tell how far the
/// surface reaches, so steps that enclose the least volume draw spikes where thin parts end. Therefore no vertex leaves
/// the surface's box by more than a fiftieth of its extents, 5 extents over the number of faces, and a voxel; an
/// icosahedron around a ball, of 20 faces, takes an eighth of an extent. There is no bound for fewer faces than a box
/// has (kLeastFacesWithRoom), which may need all space to exist, and if no number is wanted (0): then errors are the
/// bound.
[[nodiscard]] LatticeBox room_around(const LatticeBox& surface, std::uint64_t faces);
constexpr std::uint64_t kFacesOfBox = 12, kLeastFacesWithRoom = kFacesOfBox;

}  // namespace bp
