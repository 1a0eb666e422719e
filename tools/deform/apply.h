#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/deform/weight_file.h"
#include "io/scene/scene_pose.h"
#include "tools/cli/progress.h"
#include "tools/deform/bind.h"

namespace bp {

struct ApplyRequest {
  std::string weights, scene;
  std::uint64_t memory_bytes = 0;
  SceneOptions scene_options;
  NoteOfCage note;
};

/// A moved cage: a file, in one of its poses.
struct MovedCage {
  std::string path;
  std::shared_ptr<const ScenePose> pose;
};
/// Returns all poses of the files, one file after the other (read_poses()).
[[nodiscard]] std::vector<MovedCage> moved_cages(std::span<const std::string> paths, const SceneOptions& options,
                                                 std::optional<double> per_second);

struct Applied {
  std::uint64_t points = 0;
  std::string left_behind;  ///< as ScenePoints::left_behind()
};

/// As find_scene(), but throws bad_input if there is no scene. `path`: the file of weights.
[[nodiscard]] std::string scene_of(const WeightReader& weights, const std::string& path);

/// Writes the scene of the weights as a moved cage carries it. Throws bad_input if the scene has changed since the
/// binding, or if the cage has other faces.
[[nodiscard]] Applied apply_cage(const ApplyRequest& request, const MovedCage& cage, OutputFile& out,
                                 Progress& progress);
/// Writes one glTF whose scene moves from each cage to the next, `per_second` of them in a second.
[[nodiscard]] Applied animate_cages(const ApplyRequest& request, std::span<const MovedCage> cages, double per_second,
                                    OutputFile& out, Progress& progress);

/// Returns a text that names the images and materials that `written` (the moved scene) names and that exist in the
/// folder of `scene` but not in its own folder: "names files that are not in its folder; copy them there from town:
/// town.mtl, wall.png". Empty if there are none.
[[nodiscard]] std::string files_left(const std::string& scene, const std::string& written);

}  // namespace bp
