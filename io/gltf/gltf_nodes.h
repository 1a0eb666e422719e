#pragma once
#include <optional>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/affine.h"
#include "io/scene/scene_pose.h"

/// The nodes of a glTF document: the roots, and their transforms.
namespace bp {

/// Returns whether a glTF or a tileset has the record of a tool of this suite (asset.extras.provenance). The extras of
/// other files may have the same names and mean something else. Viewers ignore them, and so do all readers here.
[[nodiscard]] bool has_record(const GltfObject& root);
/// Returns the axis that is up in the scene's own coordinates, if the record of a tool of this suite tells
/// (io/gltf/glb_file.h).
[[nodiscard]] std::optional<UpAxis> gltf_up(const GltfObject& root);
/// Returns the turn from glTF's y-up world to the scene's own coordinates. Throws Unfit if CESIUM_RTC moves the world:
/// it is followed in tiles, and in a file by itself programs disagree on it.
[[nodiscard]] Affine gltf_world(const GltfObject& root);
/// Returns the point of tiles that CESIUM_RTC names; else 0.
[[nodiscard]] Vec3d gltf_rtc_center(const GltfObject& root);
/// Returns the turn from a glTF whose axis `up` (x, y or z) is up to the axes of a tile, where z is up, as viewers turn
/// contents. Exact.
[[nodiscard]] Affine gltf_in_tile(UpAxis up);
/// Returns the root nodes of the default scene, or of the first scene if no default is named. In a document without
/// scenes, every node that is no child is a root.
[[nodiscard]] std::vector<std::uint64_t> gltf_roots(const GltfObject& root);
/// Returns how many of the nodes are children of others. Where a scene lists one, some programs place it by its parent.
[[nodiscard]] std::uint64_t children_among(const GltfObject& root, const std::vector<std::uint64_t>& nodes);
/// Returns the number of a mesh's morph targets.
[[nodiscard]] std::size_t gltf_targets(const GltfObject& mesh);
/// Returns whether a node's matrix is no translation, rotation and scale in this order: some programs lose the rest.
[[nodiscard]] bool is_sheared(const GltfObject& node);
/// Returns whether it is open which nodes a viewer draws: there is no scene, or several and none is the default.
[[nodiscard]] bool has_no_default_scene(const GltfObject& root);
/// Returns whether a viewer that knows KHR_node_visibility draws nothing of the node and what is below it.
[[nodiscard]] bool gltf_hides(const GltfObject& node);
/// Reads 16 numbers, by columns; the identity if they are missing.
[[nodiscard]] Affine gltf_matrix(const GltfObject& object, const char* key);
/// Returns the transform from a node to its parent. `pose`: replaces parts of it; null: none.
[[nodiscard]] Affine gltf_transform(const GltfObject& node, const ScenePose::Node* pose = nullptr);

}  // namespace bp
