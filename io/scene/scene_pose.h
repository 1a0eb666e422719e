#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "io/scene/scene_options.h"

namespace bp {

/// A moment of an animated glTF. Nodes that are not named here are as the file shows them before an animation plays.
/// Skins follow their joints.
struct ScenePose {
  struct Node {
    std::optional<std::array<double, 3>> translation, scale;
    std::optional<std::array<double, 4>> rotation;
    std::optional<std::vector<double>> weights;  ///< morph weights
  };
  std::map<std::uint64_t, Node> nodes;  ///< by number
  std::optional<std::size_t> target;    ///< every mesh is at its morph target of this number, if it has one
  bool base = false;                    ///< no mesh is at a morph target, whatever its weights are
};

/// Returns the poses of a file, for SceneOptions::pose. A glTF with animations has one for each key time of the first
/// animation or, with `per_second`, so many a second. A glTF with morph targets only has the one that its weights show;
/// if they are all 0, one for each target. Any other file has one, at rest. Throws bad_input if the file is broken, or
/// has more than 100,000 poses; out_of_resource if the animation takes more than options.document.
[[nodiscard]] std::vector<ScenePose> read_poses(const std::string& path, const SceneOptions& options,
                                                std::optional<double> per_second = {});

[[nodiscard]] std::vector<ScenePose> gltf_poses(const SceneFilePtr& file, const SceneOptions& options,
                                                std::optional<double> per_second);

}  // namespace bp
