#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/memory_share.h"
#include "lib/core/texture.h"
#include "lib/image/mip_image.h"
#include "lib/store/scratch.h"

namespace bp {

/// Returns bytes as a text, as files are written.
[[nodiscard]] inline std::string file_text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The image files that contents of a tileset share: those of the scene, byte for byte, and smaller ones of them for
/// contents that are seen from afar. Names are hashes of the contents, so that a changed image gets another name.
/// Thread-safe.
class ImageFiles {
 public:
  /// `images`: null: there are none. Images are not decoded: a broken one is passed on.
  explicit ImageFiles(const TextureSet* images) : images_(images) {}
  /// Images are decoded, one at a time, within `memory`. Smaller ones wait in `store`.
  ImageFiles(const TextureSet* images, Scratch& store, const MemoryShare& memory);
  ImageFiles(const ImageFiles&) = delete;
  ImageFiles& operator=(const ImageFiles&) = delete;

  /// Throws NeedsMemory if an image cannot be decoded within the memory.
  void require_memory() const;

  /// Returns the file name of an image whose sides were halved so many times, or until one texel is left; empty if the
  /// image is missing or broken.
  std::string name_of(std::uint32_t image, int halvings = 0, MipImage::Kind kind = MipImage::Kind::color);
  /// Returns the number of the image that a file of name_of() shows.
  [[nodiscard]] std::uint32_t image_of(const std::string& name) const { return sources_.at(name).image; }
  /// Returns the bytes of a file that name_of() named.
  [[nodiscard]] std::string bytes_of(const std::string& name) const;
  /// Returns why images are left out.
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  /// The names of an image's files: its own, and those of smaller ones. Empty: it is missing or broken.
  struct Names {
    std::once_flag once;
    std::string own;
    std::vector<std::string> smaller;  ///< halved once, twice, ...
  };
  struct Source {
    std::uint32_t image = 0;
    std::optional<Scratch::Handle> smaller;  ///< none: the scene's own file
  };
  void make(std::uint32_t image, MipImage::Kind kind, Names& out);
  void make_smaller(TextureImage image, std::uint32_t number, MipImage::Kind kind, Names& out);

  const TextureSet* images_;
  Scratch* store_ = nullptr;  // null: images are not decoded
  const MemoryShare memory_{};
  mutable std::mutex mutex_;
  std::mutex one_at_a_time_;
  std::map<std::pair<std::uint32_t, MipImage::Kind>, std::unique_ptr<Names>> names_;
  std::map<std::string, Source> sources_;
  std::map<std::uint32_t, std::string> faults_;
};

}  // namespace bp
