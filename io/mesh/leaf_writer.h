#pragma once
#include <string>

#include "io/gltf/glb_file.h"
#include "io/mesh/leaf_looks.h"
#include "lib/core/up_axis.h"
#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// Returns a leaf as the content of a tile: as tile_glb(), but positions are float32, and images lie in files of their
/// own, which leaves share. `is_scene`: it claims to be the scene itself; else it has fewer triangles, and claims
/// nothing. Same leaf, same bytes.
[[nodiscard]] std::string leaf_glb(const std::string& name, const SceneLeaf& leaf, const LeafLooks& looks, UpAxis up,
                                   const std::vector<Provenance>& provenance, bool is_scene = true);

}  // namespace bp
