#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "io/deform/weight_file.h"
#include "io/scene/scene_reader.h"
#include "tools/cli/progress.h"

namespace bp {

struct ApplyRequest {
  std::string weights, scene;
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

/// Writes the scene of the weights as a moved cage carries it. Throws bad_input if the scene has changed since, or if
/// the cage has other faces.
[[nodiscard]] Applied apply_cage(const ApplyRequest& request, const std::string& cage, OutputFile& out,
                                 Progress& progress);
/// The same for several cages: one glTF whose scene goes from each to the next, so many in a second.
[[nodiscard]] Applied animate_cages(const ApplyRequest& request, std::span<const std::string> cages, double per_second,
                                    OutputFile& out, Progress& progress);

}  // namespace bp
