#pragma once
#include <string>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/pass/voxelize/voxelize_pass.h"

/// What a person should know of a scene that was voxelized, a sentence each: what was left out, a small part that makes
/// the grid large, a flood that found no inside.
namespace bp {

[[nodiscard]] std::vector<std::string> scene_notes(const VoxelizeCounts& counts, const StreamHeader& header);

}  // namespace bp
