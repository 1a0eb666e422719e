#pragma once
#include <optional>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/affine.h"
#include "io/scene/scene_pose.h"

/// The nodes of a glTF document: where they begin, and where they stand.
namespace bp {

/// Axis that is up in the scene's own coordinates, if the asset tells (io/gltf/glb_file.h).
[[nodiscard]] std::optional<UpAxis> gltf_up(const GltfObject& root);
/// From the y-up world of glTF to the scene's own coordinates.
[[nodiscard]] Affine gltf_world(std::optional<UpAxis> up);
/// From the axes of a glTF whose axis `up` (x, y or z) is up to those of a tile, where z is, as viewers turn a content.
/// Exact.
[[nodiscard]] Affine gltf_in_tile(UpAxis up);
/// Nodes of the default scene, else of the first; without scenes every node that is no child.
[[nodiscard]] std::vector<std::uint64_t> gltf_roots(const GltfObject& root);
/// 16 numbers by columns; if they are not there, the points stay.
[[nodiscard]] Affine gltf_matrix(const GltfObject& object, const char* key);
/// From a node to its parent. `pose`: what moves it; null: nothing.
[[nodiscard]] Affine gltf_transform(const GltfObject& node, const ScenePose::Node* pose = nullptr);

}  // namespace bp
