#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "io/mesh/tile_compression.h"
#include "lib/core/texture.h"

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

}  // namespace bp
