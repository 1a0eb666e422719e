#pragma once
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "lib/pass/leaf/scene_tiles.h"
#include "tools/lod/tiles/image_files.h"

namespace bp {

/// The images that visual tiles show, each as small as the tile's error lets it be. Thread-safe.
class TileImages {
 public:
  /// `images`: null: there are none. Smaller images are made within `memory` and wait in `store`.
  TileImages(const TextureSet* images, Scratch& store, const MemoryShare& memory);
  /// Throws NeedsMemory if an image cannot be decoded within the memory.
  void require_memory() const { files_.require_memory(); }
  using Names = std::map<std::uint32_t, std::string>;  ///< by number of the image; empty: it is left out
  /// Returns the files of the images that a tile shows. An image is halved while its texels are finer than a share of
  /// the tile's error, as textures of levels are: a viewer does not tell them where it draws the tile.
  Names names_of(const SceneTile& tile);
  [[nodiscard]] const std::set<std::string>& used() const { return used_; }  ///< names of the files of all tiles
  [[nodiscard]] std::string bytes_of(const std::string& name) const { return files_.bytes_of(name); }
  [[nodiscard]] std::vector<std::string> faults() const { return files_.faults(); }

 private:
  const TextureSet* images_;
  ImageFiles files_;
  std::mutex mutex_;
  std::set<std::string> used_;
};

}  // namespace bp
