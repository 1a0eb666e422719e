#pragma once
#include <set>
#include <string>

#include "lib/core/grid_frame.h"
#include "lib/volume/leaks.h"

/// How the tools tell the leaks of a scene.
namespace bp {

/// Returns the middle of a voxel, scene units.
[[nodiscard]] Vec3d middle_of(VoxelCoord p, const GridFrame& frame);
/// Returns the axis of the voxels that points up.
[[nodiscard]] GroundSide ground_of(const GridFrame& frame);
/// Returns the scale at which a closing with cubes shut the leak when it was tried there (Leak::trial); if none did,
/// the least that could. Rounded up to four digits.
[[nodiscard]] double closing_scale(const Leak& leak, const GridFrame& frame);
/// Returns the scale from which on a closing fills the room instead of enclosing it.
[[nodiscard]] double filling_scale(const Leak& leak, const GridFrame& frame);
[[nodiscard]] double room_volume(const Leak& leak, const GridFrame& frame);

/// Returns "1.5,2,0.25", with as many digits as a tenth of a voxel needs.
[[nodiscard]] std::string place_text(const Vec3d& p, const GridFrame& frame);
/// Returns "the largest room (41.2) leaks at 1.5,2,0.25, where it is 0.9 wide; --scale 0.46 shuts it, as tried
/// there".
[[nodiscard]] std::string leak_sentence(const Leak& leak, const GridFrame& frame);
/// Returns "--scale 0.46 shuts it, as tried there", or the least scale that could, and why none is told that does.
[[nodiscard]] std::string scale_text(const Leak& leak, const GridFrame& frame);
/// Returns " next to 'wall' and 2 other parts", or with another word than "next to"; empty without names.
[[nodiscard]] std::string parts_text(const char* where, const std::set<std::string>& names);

}  // namespace bp
