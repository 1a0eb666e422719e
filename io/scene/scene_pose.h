#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "io/scene/scene_reader.h"

namespace bp {

/// A moment of a glTF that moves: what is not named here is as the file shows it before an animation plays. Skins
/// follow their joints.
struct ScenePose {
  struct Node {
    std::optional<std::array<double, 3>> translation, scale;
    std::optional<std::array<double, 4>> rotation;
    std::optional<std::vector<double>> weights;  ///< of morph targets
  };
  std::map<std::uint64_t, Node> nodes;  ///< by number
  std::optional<std::size_t> target;    ///< every mesh is at its morph target of this number, if it has one
  bool base = false;                    ///< no mesh has gone to any morph target, whatever its weights
};

/// The poses that a file holds, for SceneOptions::pose: of the first animation of a glTF one for each of its key times,
/// or, with `per_second`, so many a second. Of a glTF without animations and with morph targets the one that its
/// weights show; if they are all 0, one for each target. Of any other file one, at rest. Throws bad_input if the file
/// is broken, or has more than 100,000 poses; out_of_resource if the animation takes more
/// than options.document.
[[nodiscard]] std::vector<ScenePose> read_poses(const std::string& path, const SceneOptions& options,
                                                std::optional<double> per_second = {});

[[nodiscard]] std::vector<ScenePose> gltf_poses(const SceneFilePtr& file, const SceneOptions& options,
                                                std::optional<double> per_second);

}  // namespace bp
