#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/packed_normal.h"

/// Images that lie on triangles of scenes. Readers of scenes implement TextureSet (io/scene); nothing else of an image
/// is known to lib/.
namespace bp {

/// Rows from top to bottom; red, green, blue as sRGB, and straight alpha.
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

/// What is seen beyond the edge of an image.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };
/// What an alpha does: nothing; all below a cutoff is a hole; it is the share that covers what is behind.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

constexpr std::uint32_t kNoTextureImage = ~std::uint32_t(0);

/// An image of something else than colour; it lies where the material's colours do.
struct TextureMap {
  std::uint32_t image = kNoTextureImage;
  std::array<TextureWrap, 2> wrap{};
  [[nodiscard]] bool is_there() const { return image != kNoTextureImage; }
  friend bool operator==(const TextureMap&, const TextureMap&) = default;
};

/// How a surface answers to light, beside its colour (glTF 2.0, section 3.9).
struct TextureSurface {
  TextureMap normal;     ///< directions in tangent space, green upwards
  TextureMap roughness;  ///< green: roughness, blue: metal; times the factors
  TextureMap emission;   ///< light of its own, times the factor
  float normal_scale = 1, roughness_factor = 1, metal_factor = 0;
  std::array<float, 3> emission_factor{};  ///< linear light
  friend bool operator==(const TextureSurface&, const TextureSurface&) = default;
};

/// How a triangle shows an image.
struct TextureMaterial {
  static constexpr std::uint32_t kNoImage = kNoTextureImage;
  std::uint32_t image = kNoImage;
  std::array<TextureWrap, 2> wrap{};  ///< along u, along v
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha = 1, cutoff = 0.5F;  ///< multiplies the image's alpha; of AlphaMode::mask
  bool replaces_color = false;     ///< true: use the triangle's colour, because the image is missing; else multiply
  TextureSurface surface{};        ///< if SceneOptions::surface asked for it; else its light of its own only
  /// All that it shows; kNoImage where there is none.
  [[nodiscard]] std::array<std::uint32_t, 4> images() const {
    return {image, surface.normal.image, surface.roughness.image, surface.emission.image};
  }
};

/// What lies on a triangle beside its colours.
struct TriangleTexture {
  static constexpr std::uint32_t kNoMaterial = ~std::uint32_t(0);
  std::array<std::array<float, 2>, 3> uv{};  ///< of the corners: (0, 0) is the image's upper left, (1, 1) its lower
                                             ///< right corner; may be anything, NaN included
  std::uint32_t material = kNoMaterial;      ///< of the scene's TextureSet
  std::array<PackedNormal, 3> normals{};     ///< of the corners, if SceneOptions::surface asked for them
};

/// Materials and images of scenes. Numbers stay when a scene is read again.
class TextureSet {
 public:
  virtual ~TextureSet() = default;
  /// Thread-safe while no scene is read. `i` is one of TriangleTexture::material.
  [[nodiscard]] virtual const TextureMaterial& material(std::uint32_t i) const = 0;
  /// How many there are in what was read of the scene so far.
  [[nodiscard]] virtual std::uint32_t image_count() const = 0;
  /// Texels of an image, {0, 0} if it is missing or broken; quick. Thread-safe.
  [[nodiscard]] virtual std::array<int, 2> size(std::uint32_t i) const = 0;
  /// The file of an image as PNG, JPEG or WebP, undecoded where it is one of these; empty if it is missing.
  /// Thread-safe.
  [[nodiscard]] virtual std::vector<std::byte> file(std::uint32_t i) const = 0;
  /// Decoded at each call; thread-safe. Throws bad_input if the image is missing or broken, out_of_resource if it takes
  /// more than `most_bytes` decoded.
  [[nodiscard]] virtual TextureImage image(std::uint32_t i, std::uint64_t most_bytes) const = 0;
};

}  // namespace bp
