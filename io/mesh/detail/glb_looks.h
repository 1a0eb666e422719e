#pragma once
#include <optional>
#include <string>

#include "io/mesh/detail/glb_data.h"
#include "lib/core/texture.h"

/// Materials of a GLB that is being written, with the textures, samplers and images that they name.
namespace bp {

class GlbLooks {
 public:
  using Wrap = std::array<TextureWrap, 2>;

  explicit GlbLooks(GlbData& data) : data_(data) {}

  /// Each returns the number of an element, which is added unless the same one is there; bytes are always added.
  std::size_t add_material(const GltfOutJson& material);
  /// `wrap`: beyond the image's edge. EXT_texture_webp is used for an image of that type.
  std::size_t add_texture(std::size_t image, const Wrap& wrap, const TextureFilters& filters = {});
  std::size_t add_image(const std::string& uri);
  /// The bytes become part of the file. `type`: "image/png".
  std::size_t add_image(const std::string& bytes, const std::string& type);

  /// Gives the document all of them.
  void write();

 private:
  GlbData& data_;
  GltfOutJson materials_ = GltfOutJson::array(), samplers_ = GltfOutJson::array(), images_ = GltfOutJson::array(),
              textures_ = GltfOutJson::array();
  bool has_webp_ = false;
};

}  // namespace bp
