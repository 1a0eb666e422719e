#pragma once
#include "io/gltf/gltf_document.h"
#include "io/scene/instanced_scene.h"

namespace bp {

inline constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// Returns the places of a node's mesh by EXT_mesh_gpu_instancing, which the node has. Attributes of other names count
/// instances, too. Throws Unfit if there are no attributes.
[[nodiscard]] InstanceArray gltf_instances(GltfDocument& doc, const GltfObject& node);

}  // namespace bp
