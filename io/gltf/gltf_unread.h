#pragma once
#include "io/gltf/gltf_document.h"

namespace bp {

/// What a glTF says that may change what a viewer shows of it beyond what is read: extensions that are not known
/// (keeps_triangles()), those that move and need not be read, animations, scenes that are not there, matrices that are
/// not affine, materials that can be seen through.
[[nodiscard]] UnreadParts gltf_unread(const GltfObject& root);

}  // namespace bp
