#pragma once
#include <cstdint>
#include <string>

#include "io/deform/weight_file.h"
#include "io/scene/scene_reader.h"
#include "tools/cli/progress.h"

namespace bp {

struct ApplyRequest {
  std::string weights, scene, cage;
  std::uint64_t memory_bytes = 0;
  SceneOptions scene_options;
};

struct Applied {
  std::uint64_t points = 0;
  std::string left_behind;  ///< ScenePoints::left_behind()
};

/// The scene of weights: a relative name counts from their folder, or else from the working folder. Throws bad_input if
/// it is in neither. `path`: of the weights.
[[nodiscard]] std::string scene_of(const WeightReader& weights, const std::string& path);

/// Writes the scene that `weights` was made of as the cage carries it. Throws bad_input if the scene has changed since,
/// or if the cage has other faces.
[[nodiscard]] Applied apply_cage(WeightReader& weights, const ApplyRequest& request, OutputFile& out,
                                 Progress& progress);

}  // namespace bp
