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

/// What readers of scenes say of images: where they are, and how materials show them. Images are decoded when asked
/// for.
namespace bp {

/// Bytes of a scene's own, or a file; neither: the image is missing.
struct ImagePlace {
  std::string name;                   ///< for messages
  SceneFilePtr bytes;                 ///< may be null
  std::string path;                   ///< may be empty
  std::optional<Relief> relief = {};  ///< heights if it is grey, else directions: it is given as directions, with its
                                      ///< strength; of at most kMostRelief texels
};

/// The images of a table that cannot be shown.
struct ImageFaults {
  std::size_t images = 0;
  std::string first;  ///< "FILE: reason" of the first of them; empty if there is none
};

constexpr std::uint64_t kMostRelief = std::uint64_t(1) << 24;

class TextureTable final : public TextureSet {
 public:
  /// The number of the image, or the material, with this key; added if there is none yet. Not while others ask.
  std::uint32_t add_image(const std::string& key, ImagePlace place);
  std::uint32_t add_material(const std::string& key, const TextureMaterial& material);

  /// A texture that cannot be shown, why, and what is done instead.
  void add_fault(const std::string& fault) { faults_.insert(fault); }
  [[nodiscard]] const std::set<std::string>& faults() const { return faults_; }

  /// Whether an image is there whose head can be read.
  [[nodiscard]] bool has_images() const;
  /// Why the head of an image cannot be read, as "FILE: reason"; empty if it can.
  [[nodiscard]] std::string fault_of(std::uint32_t i) const;
  [[nodiscard]] ImageFaults image_faults() const;
  /// Of all image files together; those that are missing have none.
  [[nodiscard]] std::uint64_t file_bytes() const;
  [[nodiscard]] const TextureMaterial& material(std::uint32_t i) const override { return materials_.at(i); }
  [[nodiscard]] std::uint32_t image_count() const override { return std::uint32_t(images_.size()); }
  [[nodiscard]] std::array<int, 2> size(std::uint32_t i) const override;
  [[nodiscard]] std::vector<std::byte> file(std::uint32_t i) const override;
  [[nodiscard]] TextureImage image(std::uint32_t i, std::uint64_t most_bytes) const override;

 private:
  /// Throws bad_input where size() gives zeros.
  [[nodiscard]] std::array<int, 2> size_in_file(std::uint32_t i) const;
  std::vector<ImagePlace> images_;
  std::vector<TextureMaterial> materials_;
  std::map<std::string, std::uint32_t> image_of_, material_of_;
  std::set<std::string> faults_;
};

}  // namespace bp
