#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/texture_table.h"
#include "lib/core/color.h"

/// A material of Wavefront MTL. It has the diffuse colour, Kd, taken as sRGB, as programs show it; whether it is
/// transparent: d below 1, Tr (which is 1 - d; some write 1 for opaque) between 0 and 1, or map_d; and the image of
/// map_Kd, which replaces Kd, as in most programs. If surfaces are asked for, also Pr, Pm, Ke, their images, which
/// replace them, and the normal map of norm, or else of map_Bump or bump, which is heights if it is grey.
namespace bp {

struct MtlMap {
  std::string image;  ///< as the file names it; empty: none
  bool clamp = false;
  std::array<double, 4> uv{1, 0, 1, 0};  ///< factor and offset of u, of v
  double strength = 1;                   ///< -bm
  friend bool operator==(const MtlMap&, const MtlMap&) = default;
};
struct MtlMaps {
  MtlMap color, normal, bump, roughness, metal, emission;
  [[nodiscard]] std::array<const MtlMap*, 6> all() const {
    return {&color, &normal, &bump, &roughness, &metal, &emission};
  }
};

struct MtlMaterial {
  const std::string* file = nullptr;  ///< path of the file that has it; null: no file has it
  LinearColor diffuse, emission{0, 0, 0};
  bool see_through = false;
  double alpha = 1, roughness = 1, metal = 0;
  std::unique_ptr<MtlMaps> own_maps;    ///< null: it has none; most materials of a large file have none
  std::optional<std::uint32_t> number;  ///< in the table of textures

  [[nodiscard]] const MtlMaps& maps() const;
  /// Returns the image whose coordinates count for all images of the material.
  [[nodiscard]] const MtlMap& first_map() const;
  /// Returns the bytes outside of the object itself.
  [[nodiscard]] std::uint64_t heap_bytes() const;
  /// Returns whether the material has an image of colours or light (map_Kd, map_Ke).
  [[nodiscard]] bool has_image() const { return !maps().color.image.empty() || !maps().emission.image.empty(); }
  /// Returns the colour. Unless surfaces are asked for, the light (Ke) of a material without images is added.
  [[nodiscard]] LinearColor color(bool surface) const;
  /// Returns the place in the image for texture coordinates of a face (vt).
  [[nodiscard]] std::array<float, 2> place(double u, double v) const;
};

/// Returns the folder part of a path; empty, or with a slash at its end.
[[nodiscard]] std::string folder_before(const std::string& path);

/// Returns the bytes of a string outside the string object, with those that the allocator adds.
[[nodiscard]] std::uint64_t heap_bytes(const std::string& text);

/// Reads the rest of a line that begins with `key`. Throws bad_input if it cannot be read.
void read_mtl_line(TextScanner& text, const std::string& key, MtlMaterial& material);

/// Adds the material's images to `textures`, and their faults; returns its number, TriangleTexture::kNoMaterial if it
/// has no image and no `details` are asked for (SceneOptions).
[[nodiscard]] std::uint32_t texture_of(MtlMaterial& material, const std::string& name, TextureTable& textures,
                                       bool surface, bool details);

}  // namespace bp
