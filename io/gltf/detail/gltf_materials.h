#pragma once
#include "io/gltf/gltf_document.h"

namespace bp {

/// Returns whether a material is glass by KHR_materials_transmission, whatever its alphaMode is.
[[nodiscard]] bool transmits_light(const GltfObject& material);

/// Reads the materials of a document. Throws bad_input where they are broken.
class GltfMaterials {
 public:
  /// Keeps references. Images are read if SceneOptions::textures is set.
  GltfMaterials(GltfDocument& doc, std::string file, const SceneOptions& options)
      : doc_(doc),
        file_(std::move(file)),
        textures_(options.textures.get()),
        surface_(options.surface),
        details_(options.surface && options.details) {}

  /// Returns linear red, green, blue and alpha that multiply image and vertex colours. Unless surfaces are asked for,
  /// the light of a material without images is added.
  [[nodiscard]] std::array<double, 4> base_color(std::uint64_t material) const;
  [[nodiscard]] bool see_through(std::uint64_t material) const;
  /// Adds the images of a material, and their coordinates, to a primitive.
  void add_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive);

 private:
  /// Images whose coordinates count for those of a material.
  struct Leaders {
    std::optional<GltfObject> first, second;
  };
  [[nodiscard]] std::optional<GltfObject> base_texture(const GltfObject& material) const;
  [[nodiscard]] Leaders leaders_of(const GltfObject& material, const std::optional<GltfObject>& base) const;
  [[nodiscard]] std::optional<Accessor> places_of(const GltfObject& info, const GltfObject& attributes,
                                                  const Primitive& primitive, std::array<double, 6>& transform);
  [[nodiscard]] std::optional<Accessor> set_of_places(std::uint64_t set, const GltfObject& attributes,
                                                      const Primitive& primitive);
  void add_spare_places(const Leaders& leaders, const GltfObject& attributes, Primitive& primitive);
  std::uint32_t texture_material(std::uint64_t i, const GltfObject& material, const std::optional<GltfObject>& base,
                                 const Leaders& leaders);
  [[nodiscard]] TextureSurface surface_of(const GltfObject& material, const Leaders& leaders);
  [[nodiscard]] MaterialDetails details_of(const GltfObject& material, const Leaders& leaders);
  void add_light(const GltfObject& material, const Leaders& leaders, TextureSurface& s);
  TextureMap map_of(const GltfObject& info, const Leaders& leaders);
  [[nodiscard]] TextureMap texture_of(const GltfObject& info);
  std::uint32_t image_of(const GltfObject& texture);

  GltfDocument& doc_;
  const std::string file_;
  TextureTable* const textures_;
  const bool surface_, details_;
};

}  // namespace bp
