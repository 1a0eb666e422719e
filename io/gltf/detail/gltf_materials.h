#pragma once
#include "io/gltf/gltf_document.h"

namespace bp {

/// What the materials of a document look like. Throws bad_input where they are broken.
class GltfMaterials {
 public:
  /// Keeps references. `textures`: null if nobody asks for them; `surface`: as SceneOptions::surface.
  GltfMaterials(GltfDocument& doc, std::string file, TextureTable* textures, bool surface)
      : doc_(doc), file_(std::move(file)), textures_(textures), surface_(surface) {}

  /// Linear red, green, blue and alpha that multiply image and vertex colours. With the light that a material without
  /// images gives, unless surfaces are asked for.
  [[nodiscard]] std::array<double, 4> base_color(std::uint64_t material) const;
  [[nodiscard]] bool see_through(std::uint64_t material) const;
  /// What lies on a primitive with this material, and where.
  void add_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive);

 private:
  [[nodiscard]] std::optional<GltfObject> base_texture(const GltfObject& material) const;
  void add_places(const GltfObject& info, const GltfObject& attributes, Primitive& primitive);
  std::uint32_t texture_material(std::uint64_t i, const GltfObject& material, const std::optional<GltfObject>& base);
  [[nodiscard]] TextureSurface surface_of(const GltfObject& material, const std::optional<GltfObject>& places);
  /// That says where all of a material's images lie, if it has none of colours.
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
