#pragma once
#include "io/scene/raw_source.h"

/// Chooses the reader of a scene's file.
namespace bp {

/// Throws bad_input for a stream of voxels, which is no scene.
[[nodiscard]] SceneFilePtr open_scene_or_mesh(const std::string& path, const SceneOptions& options);

/// Opens a file with the reader that the extension of `path` tells, else options.format, else the first bytes. Throws
/// bad_input if none of them tells.
[[nodiscard]] RawSourcePtr open_raw(const SceneFilePtr& file, const std::string& path, const SceneOptions& options);
[[nodiscard]] RawSourcePtr open_raw(const std::string& path, const SceneOptions& options);

}  // namespace bp
