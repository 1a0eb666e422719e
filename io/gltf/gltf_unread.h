#pragma once
#include "io/gltf/gltf_document.h"

namespace bp {

/// Returns the content of a glTF that is not read and may change what a viewer shows: unknown extensions
/// (keeps_triangles()), extensions that move meshes and need not be read, animations, missing scenes, matrices that are
/// not affine, transparent materials and glass.
[[nodiscard]] UnreadParts gltf_unread(const GltfObject& root);

/// Returns whether programs that do not know the extension must refuse the document.
[[nodiscard]] bool requires_extension(const GltfObject& root, const std::string& name);

}  // namespace bp
