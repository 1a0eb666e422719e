#pragma once
#include <functional>
#include <optional>

#include "lib/core/memory_share.h"
#include "lib/grid/bit_box.h"
#include "lib/volume/leak.h"

namespace bp {

/// The ground: all voxels up to the lowest solid ones count as solid. `axis` points up; `down`: it points down.
struct GroundSide {
  int axis = 1;
  bool down = false;
};

/// Resources of a search for leaks, and how much it tells.
struct LeakSearchOptions {
  MemoryShare memory{};
  std::size_t trials = 0;  ///< closings are tried around so many leaks, those of the largest rooms; at most kMostTrials
  /// Receives the name of a step and its unit, how many units are done, and of how many (0: not known). It may be
  /// empty, and may throw.
  std::function<void(const char* step, const char* unit, std::uint64_t done, std::uint64_t total)> progress;
};
constexpr std::size_t kMostTrials = 10;

/// Finds the leaks of solid voxels. A room must be a quarter wider than its opening; wider alleys and courts under the
/// open sky are no rooms. If several openings of a room are equally wide, the one is told that needs the shortest way.
/// Throws NeedsMemory if the memory is less than leaks_bytes(), and Cancelled if the caller's work is to stop. Cost:
/// the voxels of the bounds times the mean clearance, and a closing of some million voxels for each scale that is
/// tried. The work is parallel only in part. The result does not depend on threads or memory.
[[nodiscard]] Leaks find_leaks(const BitBox& solid, const std::optional<GroundSide>& ground = {},
                               const LeakSearchOptions& options = {});
/// Returns the bytes that a search takes at most for solid voxels within such a box.
[[nodiscard]] std::uint64_t leaks_bytes(const VoxelBox& box);

/// Finds the leaks, and decides whether the voxels stand on `ground`: they do if rooms then hold a quarter more.
struct GroundedLeaks : Leaks {
  bool on_ground = false;
};
[[nodiscard]] GroundedLeaks find_grounded_leaks(const BitBox& solid, const GroundSide& ground,
                                                const LeakSearchOptions& options = {});

}  // namespace bp
