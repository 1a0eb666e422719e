#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/image/relief.h"
#include "io/scene/scene_file.h"
#include "lib/core/texture.h"

/// The images that readers of scenes find: their places, and how materials show them. Images are decoded when they are
/// needed.
namespace bp {

/// The place of an image: bytes within a scene, or a file; neither: the image is missing.
struct ImagePlace {
  std::string name;    ///< for messages
  SceneFilePtr bytes;  ///< may be null
  std::string path;    ///< may be empty
  /// Heights if the image is grey, else directions. The image is delivered as directions with this strength; it may
  /// have at most kMostRelief texels.
  std::optional<Relief> relief = {};
};

/// The images of a table that cannot be shown.
struct ImageFaults {
  std::size_t images = 0;
  std::string first;  ///< "FILE: reason" for the first of them; empty if there is none
};

constexpr std::uint64_t kMostRelief = std::uint64_t(1) << 24;

class TextureTable final : public TextureSet {
 public:
  /// Return the number of the image, or the material, with this key, which is added if it is new. Not thread-safe.
  std::uint32_t add_image(const std::string& key, ImagePlace place);
  std::uint32_t add_material(const std::string& key, const TextureMaterial& material);

  /// Adds a fault: a texture that cannot be shown, the reason, and what is done instead.
  void add_fault(const std::string& fault) { faults_.insert(fault); }
  [[nodiscard]] const std::set<std::string>& faults() const { return faults_; }

  /// Returns whether there is an image whose head can be read.
  [[nodiscard]] bool has_images() const;
  /// Returns why the head of an image cannot be read, as "FILE: reason"; empty if it can.
  [[nodiscard]] std::string fault_of(std::uint32_t i) const;
  [[nodiscard]] ImageFaults image_faults() const;
  /// Returns the size of all image files together; missing ones count as 0.
  [[nodiscard]] std::uint64_t file_bytes() const;
  /// Returns the size of all images as file() returns them, at most.
  [[nodiscard]] std::uint64_t written_bytes() const;
  [[nodiscard]] const TextureMaterial& material(std::uint32_t i) const override { return materials_.at(i); }
  [[nodiscard]] std::uint32_t image_count() const override { return std::uint32_t(images_.size()); }
  [[nodiscard]] std::array<int, 2> size(std::uint32_t i) const override;
  [[nodiscard]] std::vector<std::byte> file(std::uint32_t i) const override;
  [[nodiscard]] TextureImage image(std::uint32_t i, std::uint64_t most_bytes) const override;

 private:
  /// Returns the size; throws bad_input where size() returns zeros.
  [[nodiscard]] std::array<int, 2> size_in_file(std::uint32_t i) const;
  std::vector<ImagePlace> images_;
  std::vector<TextureMaterial> materials_;
  std::map<std::string, std::uint32_t> image_of_, material_of_;
  std::set<std::string> faults_;
};

}  // namespace bp
