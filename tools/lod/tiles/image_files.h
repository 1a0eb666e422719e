#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/texture.h"
#include "lib/image/mip_image.h"
#include "lib/store/scratch.h"

namespace bp {

/// The image files that contents of a tileset share: those of the scene, byte for byte, and smaller ones of them for
/// contents that are seen from afar. Names are hashes of the contents, so that a changed image gets another name.
/// Thread-safe.
class ImageFiles {
 public:
  /// `images`: null: there are none. Smaller images wait in `store`; null: none is asked for. `most_bytes`: memory for
  /// one image that is made smaller; one is at a time.
  explicit ImageFiles(const TextureSet* images, Scratch* store = nullptr, std::uint64_t most_bytes = 0);
  ~ImageFiles();
  ImageFiles(const ImageFiles&) = delete;
  ImageFiles& operator=(const ImageFiles&) = delete;

  /// Returns the file name of an image whose sides were halved so many times, or until one texel is left; empty if the
  /// image is missing or broken.
  std::string name_of(std::uint32_t image, int halvings = 0, MipImage::Kind kind = MipImage::Kind::color);
  /// Returns the number of the image that a file of name_of() shows.
  [[nodiscard]] std::uint32_t image_of(const std::string& name) const { return sources_.at(name).image; }
  /// Returns the bytes of a file that name_of() named.
  [[nodiscard]] std::string bytes_of(const std::string& name) const;
  /// Returns why images could not be made smaller; they are left out.
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  struct Smaller;
  struct Source {
    std::uint32_t image = 0;
    std::optional<Scratch::Handle> smaller;  ///< none: the scene's own file
  };
  std::string own_name(std::uint32_t image);
  void make_smaller(std::uint32_t image, MipImage::Kind kind, Smaller& out);

  const TextureSet* images_;
  Scratch* store_;
  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::mutex one_at_a_time_;
  std::map<std::uint32_t, std::string> own_;
  std::map<std::pair<std::uint32_t, MipImage::Kind>, std::unique_ptr<Smaller>> smaller_;
  std::map<std::string, Source> sources_;
  std::map<std::uint32_t, std::string> faults_;
};

}  // namespace bp
