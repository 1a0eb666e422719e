#pragma once
#include "io/gltf/gltf_document.h"

namespace bp {

/// Reads the materials of a document. Throws bad_input where they are broken.
class GltfMaterials {
 public:
  /// Keeps references. `textures`: null if images are not asked for; `surface`: as SceneOptions::surface.
  GltfMaterials(GltfDocument& doc, std::string file, TextureTable* textures, bool surface)
      : doc_(doc), file_(std::move(file)), textures_(textures), surface_(surface) {}

  /// Returns linear red, green, blue and alpha that multiply image and vertex colours. Unless surfaces are asked for,
  /// the light of a material without images is added.
  [[nodiscard]] std::array<double, 4> base_color(std::uint64_t material) const;
  [[nodiscard]] bool see_through(std::uint64_t material) const;
  /// Adds the images of a material, and their coordinates, to a primitive.
  void add_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive);

 private:
  [[nodiscard]] std::optional<GltfObject> base_texture(const GltfObject& material) const;
  void add_places(const GltfObject& info, const GltfObject& attributes, Primitive& primitive);
  std::uint32_t texture_material(std::uint64_t i, const GltfObject& material, const std::optional<GltfObject>& base);
  [[nodiscard]] TextureSurface surface_of(const GltfObject& material, const std::optional<GltfObject>& places);
  /// Returns the image whose coordinates count for all images of a material without an image of colours.
  [[nodiscard]] std::optional<GltfObject> first_other(const GltfObject& material) const;
  void add_light(const GltfObject& material, const std::optional<GltfObject>& places, TextureSurface& s);
  TextureMap map_of(const GltfObject& info, const std::optional<GltfObject>& places);
  [[nodiscard]] std::array<TextureWrap, 2> wrap_of(const GltfObject& texture) const;
  std::uint32_t image_of(const GltfObject& texture);

  GltfDocument& doc_;
  const std::string file_;
  TextureTable* const textures_;
  const bool surface_;
};

}  // namespace bp
