#pragma once
#include "lib/atlas/atlas.h"
#include "lib/core/texture.h"
#include "lib/pass/bake/scene_looks.h"

/// Textures of meshes that stand for a scene: each texel shows what is seen of the scene there, from outside, along the
/// mesh's normal (docs/decisions/0021-textures.md).
namespace bp {

struct BakeParams {
  double reach_world = 0;  ///< so far along the normal the scene is looked for, scene units
  bool both_ways = false;  ///< outwards, too: the mesh may lie inside; the nearest counts
  MemoryShare memory{};    ///< for the images
};

/// How a level answers to light; as many texels as the image of colours.
struct BakedSurface {
  TextureImage color;
  TextureImage normal;     ///< in the tangent space of tangents_of(), green upwards
  TextureImage roughness;  ///< green: roughness, blue: metal
  TextureImage emission;   ///< sRGB
};

/// Colours are means over a texel, in linear light. A texel whose line meets nothing within the reach shows the nearest
/// place of the scene within it, which may be a hole; one whose line goes only through holes of the scene's textures is
/// a hole (alpha). Texels outside the charts, and those without a place, have colours of those beside
/// them, and are holes where those are. The
/// result does not depend on threads. Cost: four lines through the scene for each texel; 9 bytes a texel. Throws
/// NeedsMemory.
[[nodiscard]] TextureImage bake(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks,
                                const BakeParams& params);

/// Besides, normals, roughness, metal and light of what is seen, where bake() takes its colour: means, by how much is
/// covered. 21 bytes a texel.
[[nodiscard]] BakedSurface bake_surface(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks,
                                        const BakeParams& params);

/// Whether an image of normals says hardly more than the mesh's own. At the edge of a roof a texel may see the wall,
/// also where the mesh lies on the scene. So one texel in a hundred may lean by more than 4 degrees, but no square of
/// 8 x 8 texels may have more than half of its texels lean: that is a detail, however small its share of the image.
/// O(texels).
[[nodiscard]] bool says_nothing(const TextureImage& normals);

}  // namespace bp
