#pragma once
#include <optional>
#include <vector>

#include "lib/core/memory_share.h"
#include "lib/grid/bit_box.h"

/// Finds where the inside of a building or a machine leaks: the narrowest place on the widest way from the outside into
/// each room that is not closed.
///
/// The clearance of an empty voxel is its distance to the nearest solid voxel along the farthest axis (Chebyshev), so
/// the cubes of a closing at scale S fill every voxel whose clearance is at most S, in voxels. The bottleneck of a way
/// over faces of empty voxels is its least clearance. A room with a leak of clearance d is a connected set of voxels of
/// more than d that the outside reaches by ways with a bottleneck of d, but of no more. Hence no closing with S < d
/// separates it from the outside, and the dilation of one with S >= d does. These are the merges of the tree of
/// components over falling clearance (a maximum spanning tree); they are exact.
namespace bp {

struct Leak {
  VoxelCoord place;            ///< middle of the opening; an empty voxel
  VoxelCoord inner, outer;     ///< ends of the shortest way through the opening, in the room and outside it
  std::int32_t clearance = 0;  ///< d, voxels
  /// Least scale, whole voxels, of the closings that were tried around the opening (detail/shut_trial.h) and shut it:
  /// d, or more if the opening is slanted, since closings erode by balls. A larger scale may open it again. 0: none of
  /// them does up to 3 d, or the opening is too large to try.
  std::int32_t shut_at = 0;
  std::int32_t width = 0;           ///< of the opening, voxels: 2 d - 1 or 2 d, or a little more if it is slanted
  std::int32_t room_clearance = 0;  ///< largest clearance in the room; a closing of that scale fills the room
  /// Voxels of all cubes in the room that are wider than the opening: the room without narrow corners, and without the
  /// opening itself.
  std::uint64_t room_voxels = 0;
};

struct Leaks {
  std::vector<Leak> leaks;          ///< the largest room first; rooms below a thousandth of it are left out
  std::uint64_t closed_voxels = 0;  ///< empty voxels that the outside does not reach
  [[nodiscard]] std::uint64_t all_voxels() const {
    std::uint64_t all = closed_voxels;
    for (const Leak& leak : leaks) all += leak.room_voxels;
    return all;
  }
};

/// The ground: all voxels up to the lowest solid ones count as solid. `axis` points up; `down`: it points down.
struct GroundSide {
  int axis = 1;
  bool down = false;
};

/// Finds the leaks of solid voxels. A room must be a quarter wider than its opening; wider alleys and courts under the
/// open sky are no rooms. If several openings of a room are equally wide, the one is told that needs the shortest way.
/// Throws NeedsMemory if `memory` has less than leaks_bytes(). Cost: the voxels of the bounds times the mean clearance.
/// The work is parallel only in part. The result does not depend on threads or memory.
[[nodiscard]] Leaks find_leaks(const BitBox& solid, const std::optional<GroundSide>& ground = {},
                               const MemoryShare& memory = {});
/// Returns the bytes that find_leaks() takes at most for solid voxels within such a box.
[[nodiscard]] std::uint64_t leaks_bytes(const VoxelBox& box);

/// Finds the leaks, and decides whether the voxels stand on `ground`: they do if rooms then hold a quarter more.
struct GroundedLeaks : Leaks {
  bool on_ground = false;
};
[[nodiscard]] GroundedLeaks find_grounded_leaks(const BitBox& solid, const GroundSide& ground,
                                                const MemoryShare& memory = {});

}  // namespace bp
