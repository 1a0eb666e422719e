#pragma once
#include <map>
#include <string>

#include "io/scene/detail/text_scanner.h"
#include "io/scene/texture_table.h"
#include "lib/core/color.h"

/// Wavefront MTL: of the materials the diffuse colour, Kd, taken as sRGB, as programs show it; and whether they can be
/// seen through: d below 1, Tr (which is 1 - d; some write 1 for opaque) between 0 and 1, or map_d; and
/// the image of map_Kd, which replaces Kd, as most programs have it.
namespace bp {

class MtlMaterials {
 public:
  /// Adds those of a file that lies beside the file `beside`; one of the same name replaces. A file that is not there
  /// or cannot be understood adds none: a scene without colours is still a scene. An OBJ without a path has none.
  void load(const std::string& beside, const std::string& name);
  /// White if there is no such material.
  [[nodiscard]] LinearColor color(const std::string& material) const;
  /// Of a place that a face gives (vt): the place in the image.
  [[nodiscard]] std::array<float, 2> place(const std::string& material, double u, double v) const;
  /// Its image on triangles (map_Kd), added to `textures`; TriangleTexture::kNoMaterial if it has none.
  [[nodiscard]] std::uint32_t texture(const std::string& material, TextureTable& textures) const;
  /// False if there is no such material.
  [[nodiscard]] bool see_through(const std::string& material) const;

 private:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  struct Material {
    LinearColor color;
    bool see_through = false;
    std::string image;  // path; empty: none
    bool clamp = false, holes = false;
    double alpha = 1;
    std::array<double, 4> uv{1, 0, 1, 0};  // factor and offset of u, of v
  };
  void read(const std::string& path);
  static void read_image(TextScanner& text, const std::string& folder, Material& material);
  std::map<std::string, Material> materials_;
};

}  // namespace bp
