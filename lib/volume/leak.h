#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/coords.h"

/// Leaks of a building or a machine: the narrowest place on the widest way from the outside into each room that is not
/// closed.
///
/// The clearance of an empty voxel is its distance to the nearest solid voxel along the farthest axis (Chebyshev), so
/// the cubes of a closing at scale S fill every voxel whose clearance is at most S, in voxels. The bottleneck of a way
/// over faces of empty voxels is its least clearance. A room with a leak of clearance d is a connected set of voxels of
/// more than d that the outside reaches by ways with a bottleneck of d, but of no more. Hence no closing with S < d
/// separates it from the outside, and the dilation of one with S >= d does. These are the merges of the tree of
/// components over falling clearance (a maximum spanning tree); they are exact.
namespace bp {

/// The result of trying closings around an opening.
struct ShutTrial {
  enum class Answer {
    untried,  ///< no closing was tried, or too few: the surroundings in which room and outside are joined are too large
    shut,     ///< the closing at `scale_vox` shuts the opening
    open,     ///< none of them shuts it, up to three times the least that could
    filled,   ///< none of them shuts it below the scale that fills the room
  };
  Answer answer = Answer::untried;
  std::int32_t scale_vox = 0;  ///< whole voxels; 0 if no closing shuts the opening
};

struct Leak {
  VoxelCoord place;            ///< middle of the opening; an empty voxel
  VoxelCoord inner, outer;     ///< ends of the shortest way through the opening, in the room and outside it
  std::int32_t clearance = 0;  ///< d, voxels
  /// The closings that were tried, the least scale first (detail/shut_trial.h). The scale that shuts the opening is d,
  /// or more if it is slanted, since closings erode by balls. A larger scale may open it again.
  ShutTrial trial;
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

}  // namespace bp
