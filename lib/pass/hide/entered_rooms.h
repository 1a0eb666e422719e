#pragma once
#include <optional>

#include "lib/pass/close/close_pass.h"

/// Rooms that somebody enters. They are not hidden, although a closing shuts their doors.
namespace bp {

/// The part of a room's usual height that a body has if its height is not told: doors reach 2.1 m of 2.5 to 3 m, and
/// windows less than 1.5 m.
constexpr double kBodyOfRoom = 0.6;

/// The voxels that a body enters, the set P.
struct Entered {
  double body_world = 0;  ///< height of the body, scene units
  BitBox voxels;          ///< entered_voxels()
};
/// Returns what bodies of a height enter. `touched`: the bricks of `header`. `body_world`: 0: kBodyOfRoom of the usual
/// height. Nothing if the scene has no such height. Throws NeedsMemory, and bad_argument if a body is less than two
/// voxels wide, since it might pass an opening that the voxels do not show, or more than kMostBodyVox high.
[[nodiscard]] std::optional<Entered> entered_by(const StreamHeader& header, const BrickShelf& touched,
                                                double body_world, const PassContext& context);

/// Returns the usual height of rooms, in voxels: half of the empty voxels between solid ones above and below are in
/// columns that are at most so high. `up`: the axis. 0 if there are none.
[[nodiscard]] std::int32_t usual_height(const BitBox& solid, int up);

/// Takes the rooms that hold a voxel of P out of `filled`, which has the closing and the rooms that it encloses.
/// Returns whether other rooms are left.
[[nodiscard]] bool leave_open(const BitBox& entered, const BrickShelf& closed, BrickShelf& filled);
/// Takes voxels out of a shelf.
void take_out(const BitBox& voxels, BrickShelf& from);

/// An opening by which somebody gets into hidden voxels.
struct Entrance {
  std::uint64_t hidden = 0;  ///< number of hidden voxels in P
  VoxelBox opening;          ///< around the voxels of P where the hidden ones begin, of the largest opening
};
/// Returns the largest entrance; hidden 0: there is none.
[[nodiscard]] Entrance entrance_of(const BitBox& entered, const BrickShelf& hidden);

}  // namespace bp
