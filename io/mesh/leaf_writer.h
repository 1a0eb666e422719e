#pragma once
#include <functional>
#include <string>

#include "io/gltf/glb_file.h"
#include "io/mesh/tile_compression.h"
#include "lib/core/up_axis.h"
#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// Returns the file of a material's image in the leaf's folder; empty: it has none.
using LeafImageName = std::function<std::string(std::uint32_t image)>;

/// Images and colours of a leaf.
struct LeafLooks {
  const TextureSet* images = nullptr;  ///< null: no images
  LeafImageName name_of;               ///< null: images are part of the file
  bool colors = true;                  ///< false: the leaf is grey
  TileCompression compression = TileCompression::meshopt;
};

/// Returns a leaf as the content of a tile: as tile_glb(), but positions are float32, and images lie in files of their
/// own, which leaves share. Both sides of triangles are shown. Same leaf, same bytes.
[[nodiscard]] std::string leaf_glb(const std::string& name, const SceneLeaf& leaf, const LeafLooks& looks, UpAxis up,
                                   const std::vector<Provenance>& provenance);

}  // namespace bp
