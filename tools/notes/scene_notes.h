#pragma once
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/grid/stream.h"
#include "lib/pass/voxelize/voxelize_pass.h"

/// Notes on a scene that was voxelized, a sentence each: what was left out, a small part that makes the grid large, a
/// flood that found no inside, a place on the globe that is lost.
namespace bp {

/// How to read a scene again, for the names of its parts.
struct SceneAgain {
  std::vector<std::string> files;  ///< not read if stdin is among them
  SceneOptions options;
};

/// Returns the notes. Reads the scene again only if a small part makes the grid large.
[[nodiscard]] std::vector<std::string> scene_notes(const VoxelizeCounts& counts, const StreamHeader& header,
                                                   const SceneAgain& scene);

}  // namespace bp
