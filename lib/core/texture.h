#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/packed_normal.h"

/// Images that lie on a scene's triangles. Readers of scenes implement TextureSet (io/scene). lib/ knows nothing else
/// of an image.
namespace bp {

/// Pixels by rows from top to bottom: red, green and blue as sRGB, and straight alpha.
struct TextureImage {
  using Texel = std::array<std::uint8_t, 4>;
  int width = 0, height = 0;
  std::vector<Texel> texels;

  TextureImage() = default;
  TextureImage(int w, int h, Texel fill = {}) : width(w), height(h), texels(std::size_t(w) * std::size_t(h), fill) {}
  [[nodiscard]] Texel& at(int x, int y) { return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  [[nodiscard]] const Texel& at(int x, int y) const {
    return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }
};

/// How an image continues beyond its edge.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };
/// The meaning of alpha. opaque: nothing. mask: below a cutoff there is a hole. blend: it is the covering share.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

constexpr std::uint32_t kNoTextureImage = ~std::uint32_t(0);

/// Numbers of glTF's minFilter and magFilter; 0: the scene does not tell.
using TextureFilters = std::array<std::uint16_t, 2>;

/// An image of something other than colour. It is placed as the image of the material's colours is, unless
/// SceneOptions::details asks for second places.
struct TextureMap {
  std::uint32_t image = kNoTextureImage;
  std::array<TextureWrap, 2> wrap{};
  TextureFilters filters{};
  bool in_second_places = false;  ///< it lies at TriangleTexture::second_uv
  [[nodiscard]] bool is_there() const { return image != kNoTextureImage; }
  friend bool operator==(const TextureMap&, const TextureMap&) = default;
};

/// How a surface answers to light, in addition to its colour (glTF 2.0, section 3.9).
struct TextureSurface {
  TextureMap normal;     ///< directions in tangent space, green upwards
  TextureMap roughness;  ///< green: roughness, blue: metal; multiplied by the factors
  TextureMap emission;   ///< emitted light, multiplied by the factor
  float normal_scale = 1, roughness_factor = 1, metal_factor = 0;
  std::array<float, 3> emission_factor{};  ///< linear light
  friend bool operator==(const TextureSurface&, const TextureSurface&) = default;
};

/// The rest of what a scene says about a material. Only faces of the scene keep it, so it is read if
/// SceneOptions::details asks for it.
struct MaterialDetails {
  std::string name;
  bool double_sided = true;
  TextureMap occlusion;  ///< red: the share of the surrounding light that arrives
  float occlusion_strength = 1;
  std::string extensions;  ///< glTF's extensions of the material that name no image, as a JSON object; empty: none
  friend bool operator==(const MaterialDetails&, const MaterialDetails&) = default;
};

/// How a triangle shows an image.
struct TextureMaterial {
  static constexpr std::uint32_t kNoImage = kNoTextureImage;
  std::uint32_t image = kNoImage;
  std::array<TextureWrap, 2> wrap{};  ///< along u, along v
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha = 1, cutoff = 0.5F;  ///< alpha multiplies the image's alpha; cutoff is that of AlphaMode::mask
  /// true: the image is missing, so the triangle's colour is used; false: both are multiplied
  bool replaces_color = false;
  TextureSurface surface{};  ///< only `emission` is set unless SceneOptions::surface asks for all
  TextureFilters filters{};  ///< of `image`
  MaterialDetails details{};
  /// Returns all images that it shows, kNoImage where there is none.
  [[nodiscard]] std::array<std::uint32_t, 5> images() const {
    return {image, surface.normal.image, surface.roughness.image, surface.emission.image, details.occlusion.image};
  }
};

/// The texture of a triangle, in addition to its colours.
struct TriangleTexture {
  static constexpr std::uint32_t kNoMaterial = ~std::uint32_t(0);
  /// At the corners: (0, 0) is the image's upper left, (1, 1) its lower right corner; any value may occur, NaN too.
  std::array<std::array<float, 2>, 3> uv{};
  std::uint32_t material = kNoMaterial;   ///< number in the scene's TextureSet
  std::array<PackedNormal, 3> normals{};  ///< at the corners, if SceneOptions::surface asks for them
  std::array<std::array<float, 2>, 3>
      second_uv{};  ///< more places at the corners, if SceneOptions::details asks for them
};

/// Materials and images of scenes. Their numbers stay when a scene is read again.
class TextureSet {
 public:
  virtual ~TextureSet() = default;
  /// Returns a material; `i` is a TriangleTexture::material. Several threads may call it, but not while a scene is
  /// being read.
  [[nodiscard]] virtual const TextureMaterial& material(std::uint32_t i) const = 0;
  /// Returns the number of images in the part of the scene that was read so far.
  [[nodiscard]] virtual std::uint32_t image_count() const = 0;
  /// Returns the texels of an image, {0, 0} if it is missing or broken. Quick and thread-safe.
  [[nodiscard]] virtual std::array<int, 2> size(std::uint32_t i) const = 0;
  /// Returns the file of an image, as it is if it is PNG, JPEG or WebP. Empty if it is missing. Thread-safe.
  [[nodiscard]] virtual std::vector<std::byte> file(std::uint32_t i) const = 0;
  /// Decodes the image at each call. Thread-safe. Throws bad_input if it is missing or broken, out_of_resource if it
  /// takes more than `most_bytes` decoded.
  [[nodiscard]] virtual TextureImage image(std::uint32_t i, std::uint64_t most_bytes) const = 0;
};

}  // namespace bp
