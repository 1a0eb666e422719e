#pragma once
#include "lib/atlas/atlas.h"
#include "lib/core/texture.h"
#include "lib/pass/bake/scene_looks.h"

/// Textures of meshes that stand for a scene. Each texel shows the part of the scene that is seen there from outside,
/// along the mesh's normal (docs/decisions/0021-textures.md).
namespace bp {

struct BakeParams {
  double reach_world = 0;  ///< how far along the normal the scene is looked for, scene units
  bool both_ways = false;  ///< looks outwards, too, since the mesh may lie inside; the nearest surface counts
  MemoryShare memory{};    ///< for the images
};

/// Images of how a level answers to light; they have as many texels as the image of colours.
struct BakedSurface {
  TextureImage color;
  TextureImage normal;     ///< in the tangent space of tangents_of(), green upwards
  TextureImage roughness;  ///< green: roughness, blue: metal
  TextureImage emission;   ///< sRGB
};

/// Returns the memory that bake() takes, or bake_surface() with `surfaces`.
[[nodiscard]] std::uint64_t bytes_to_bake(const LatticeMesh& mesh, const Atlas& atlas, bool surfaces);

/// Bakes the image of colours. A colour is the mean over a texel, in linear light. If the line of a texel meets nothing
/// within the reach, it shows the nearest place of the scene within it, which may be a hole. If the line goes only
/// through holes of the scene's textures, the texel is a hole (alpha). Texels outside the charts, and texels without a
/// place, have colours of their neighbours, and are holes if these are. The result does not depend on threads. Cost:
/// four lines through the scene for each texel; 9 bytes a texel. Throws NeedsMemory.
[[nodiscard]] TextureImage bake(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks,
                                const BakeParams& params);

/// Bakes normals, roughness, metal and emitted light at the places where bake() takes its colours. They are means,
/// weighted by how much is covered. 21 bytes a texel.
[[nodiscard]] BakedSurface bake_surface(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks,
                                        const BakeParams& params);

/// Returns whether an image of normals says hardly more than the mesh's own. At the edge of a roof a texel may see the
/// wall, even if the mesh lies on the scene. So one texel in a hundred may lean by more than 4 degrees. But no square
/// of 8 x 8 texels may have more than half of its texels lean, because that is a detail, however small its share of the
/// image. O(texels).
[[nodiscard]] bool says_nothing(const TextureImage& normals);

}  // namespace bp
