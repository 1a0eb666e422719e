#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/indexed_mesh.h"

/// How the places of files relate to each other, from what they say beside their triangles.
namespace bp {

/// Returns one sentence for each turn that is undone because a glTF file says that it was turned to y up. A proxy whose
/// nodes move it gets one, too: by how much programs that compute in 32-bit floats may draw it elsewhere.
///   files  scenes, then the proxy
///   up     the axis that the reader of the proxy found
[[nodiscard]] std::vector<std::string> place_notes(const std::vector<std::string>& files, std::optional<UpAxis> up);

/// Returns why it is unknown how a file lies relative to the others: its record of a turn (asset.extras.up of glTF)
/// names no axis, or is not by a tool of ours. Empty: every record is understood. Files that cannot be read again tell
/// nothing.
[[nodiscard]] std::string unknown_axes(const std::vector<std::string>& files);

/// Returns why axes may be the cause if a proxy without a record fails. One side is glTF, where y is up, the other has
/// a format without axes, and the bounds of the proxy hold those of the scene only if one of them is turned. Empty:
/// that is not so. `scene_up`: the axis that the reader of the scenes found.
[[nodiscard]] std::string missing_axes(const std::vector<std::string>& files, const IndexedMesh& proxy,
                                       const Bounds3d& scene, std::optional<UpAxis> scene_up);

}  // namespace bp
