#include "tools/lod/tiles/tile_images.h"

#include <cmath>

#include "tools/lod/bake_levels.h"
#include "tools/lod/tiles/texel_size.h"

namespace bp {

TileImages::TileImages(const TextureSet* images, Scratch& store, const MemoryShare& memory)
    : images_(images), files_(images, store, memory) {}

TileImages::Names TileImages::names_of(const SceneTile& tile) {
  struct Use {
    MipImage::Kind kind = MipImage::Kind::numbers;
    Texels texels;
  };
  std::map<std::uint32_t, Use> uses;
  for (const LeafPart& part : tile.leaf.parts) {
    if (images_ == nullptr || part.material == TriangleTexture::kNoMaterial) continue;
    const TextureMaterial& m = images_->material(part.material);
    for (const std::uint32_t image : m.images()) {
      if (image == kNoTextureImage) continue;
      Use& use = uses[image];
      if (image == m.image || image == m.surface.emission.image) use.kind = MipImage::Kind::color;
      if (tile.error_world > 0) add_texels(tile.leaf, part, places_of(m, image), images_->size(image), use.texels);
    }
  }
  Names names;
  for (auto& [image, use] : uses) {
    const double texel = finest_of(use.texels), wanted = tile.error_world / kTexelsPerError;
    const int halvings = texel > 0 && wanted > texel ? int(std::log2(wanted / texel)) : 0;
    names[image] = files_.name_of(image, halvings, use.kind);
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [image, name] : names) {
    if (!name.empty()) used_.insert(name);
  }
  return names;
}

}  // namespace bp
