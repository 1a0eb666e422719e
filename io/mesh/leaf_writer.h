#pragma once
#include <functional>
#include <string>

#include "io/gltf/glb_file.h"
#include "io/mesh/lod_writer.h"
#include "lib/core/up_axis.h"
#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// The image of a material as a file beside the leaf; empty: it has none.
using LeafImageName = std::function<std::string(std::uint32_t image)>;

/// How a leaf looks beside its triangles.
struct LeafLooks {
  const TextureSet* images = nullptr;  ///< null: none
  LeafImageName name_of;
  bool colors = true;  ///< false: grey
  TileCompression compression = TileCompression::meshopt;
};

/// A leaf as the content of a tile: as tile_glb(), but positions are float32, and images lie in files of their own,
/// which leaves share. Both sides of triangles are shown. Same leaf, same bytes.
[[nodiscard]] std::string leaf_glb(const std::string& name, const SceneLeaf& leaf, const LeafLooks& looks, UpAxis up,
                                   const std::vector<Provenance>& provenance);

}  // namespace bp
