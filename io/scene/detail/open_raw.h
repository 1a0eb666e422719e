#pragma once
#include "io/scene/raw_source.h"

/// Which reader a scene's file goes to.
namespace bp {

/// Throws bad_input for a stream of voxels, which is no scene.
[[nodiscard]] SceneFilePtr open_scene_or_mesh(const std::string& path, const SceneOptions& options);

/// By the extension of `path`, else by options.format, else by the first bytes. Throws bad_input if none of them tells.
[[nodiscard]] RawSourcePtr open_raw(const SceneFilePtr& file, const std::string& path, const SceneOptions& options);
[[nodiscard]] RawSourcePtr open_raw(const std::string& path, const SceneOptions& options);

}  // namespace bp
