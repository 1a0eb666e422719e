#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>

#include "io/mesh/compression.h"
#include "lib/core/texture.h"

namespace bp {

/// Returns the file of a material's image in the leaf's folder; empty: it has none.
using LeafImageName = std::function<std::string(std::uint32_t image)>;

/// Returns the type of a file of TextureSet::file(), by its first byte: "image/jpeg", "image/webp" or "image/png".
[[nodiscard]] inline std::string image_type(std::span<const std::byte> file) {
  const int first = file.empty() ? 0 : std::to_integer<int>(file[0]);
  return first == 0xFF ? "image/jpeg" : first == 'R' ? "image/webp" : "image/png";
}

/// Images and colours of a leaf.
struct LeafLooks {
  const TextureSet* images = nullptr;  ///< null: no images
  LeafImageName name_of;               ///< null: images are part of the file
  bool colors = true;                  ///< false: the leaf is grey
  Compression compression = Compression::none;
  bool spare_places = false;            ///< places that no image uses are kept, for those of an engine
  std::set<std::uint32_t> broken = {};  ///< images that are left out
};

}  // namespace bp
