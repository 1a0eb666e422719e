#pragma once
#include <optional>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/affine.h"
#include "io/scene/scene_pose.h"

/// The nodes of a glTF document: the roots, and their transforms.
namespace bp {

/// Returns the axis that is up in the scene's own coordinates, if the asset tells (io/gltf/glb_file.h).
[[nodiscard]] std::optional<UpAxis> gltf_up(const GltfObject& root);
/// Returns the turn from glTF's y-up world to the scene's own coordinates.
[[nodiscard]] Affine gltf_world(std::optional<UpAxis> up);
/// Returns the turn from a glTF whose axis `up` (x, y or z) is up to the axes of a tile, where z is up, as viewers turn
/// contents. Exact.
[[nodiscard]] Affine gltf_in_tile(UpAxis up);
/// Returns the root nodes of the default scene, or of the first scene if no default is named. In a document without
/// scenes, every node that is no child is a root.
[[nodiscard]] std::vector<std::uint64_t> gltf_roots(const GltfObject& root);
/// Reads 16 numbers, by columns; the identity if they are missing.
[[nodiscard]] Affine gltf_matrix(const GltfObject& object, const char* key);
/// Returns the transform from a node to its parent. `pose`: replaces parts of it; null: none.
[[nodiscard]] Affine gltf_transform(const GltfObject& node, const ScenePose::Node* pose = nullptr);

}  // namespace bp
