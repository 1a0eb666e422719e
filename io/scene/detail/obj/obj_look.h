#pragma once
#include "io/scene/detail/obj/mtl_file.h"
#include "io/scene/scene_options.h"

namespace bp {

/// How the faces look that follow a line "usemtl", if colours or walls are asked for. Nothing but white otherwise.
class ObjLook {
 public:
  ObjLook(const SceneFilePtr& file, const SceneOptions& options);

  void use(const std::string& material);
  /// Loads a file of materials. If the materials do not fit, those of files named later are counted, too, so that the
  /// message has the right number. `text`: stands at the line that names the file.
  void load(const std::string& name, const TextScanner& text);
  void rewind();

  [[nodiscard]] const LinearColor& color() const { return color_; }
  [[nodiscard]] std::uint32_t texture() const { return texture_; }
  /// Returns the place in the image for texture coordinates.
  [[nodiscard]] std::array<float, 2> place(double u, double v);
  [[nodiscard]] bool is_passed_over() const { return passed_over_; }  ///< the faces are left out
  /// Return whether any material so far has a colour, or an image.
  [[nodiscard]] bool has_colors() const { return has_colors_; }
  [[nodiscard]] bool has_textures() const { return has_textures_; }

 private:
  const SceneFilePtr file_;
  const bool colors_, walls_only_, surface_, details_;
  const std::shared_ptr<TextureTable> textures_;
  MtlMaterials materials_;
  std::string name_;
  std::uint32_t texture_ = TriangleTexture::kNoMaterial;
  LinearColor color_ = kWhite;
  bool passed_over_ = false, has_colors_ = false, has_textures_ = false;
};

}  // namespace bp
