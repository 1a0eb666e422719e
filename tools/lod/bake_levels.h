#pragma once
#include <memory>

#include "lib/pass/bake/scene_looks.h"
#include "tools/lod/scene/lod_scene.h"

/// Bakes textures for levels from the scene's images and colours.
namespace bp {

/// Reads the looks of the scene by reading the scene once more. `memory`: for triangles and images that are at work.
[[nodiscard]] std::unique_ptr<SceneLooks> read_looks(const Build& build, const LodScene& scene,
                                                     const MemoryShare& memory);

/// Returns the limit on memory at which read_looks() has room for each image, with this share of the memory for work.
/// 0: levels get no textures.
[[nodiscard]] std::uint64_t looks_limit(const Build& build, const LodScene& scene, double share);
/// The shares of the memory for work that looks have while levels are made, and afterwards.
constexpr double kLooksBeside = 0.4, kLooksAfter = 0.6;

/// Texels along the error of a level. A level is drawn where its error is less than a pixel; CesiumJS by default draws
/// it up to 16 pixels.
constexpr double kTexelsPerError = 4;

/// Returns the error, or an estimate from scale and voxel if it is 0 (not known). It decides how fine the texture of a
/// level is.
[[nodiscard]] double error_or(double error_world, double scale_world, double voxel);

/// Returns about how many texels all textures of a level have. `error_world`: as from error_or(); 0: only the faces
/// decide.
[[nodiscard]] double planned_texels(double faces, const Bounds3d& bounds, double error_world);

/// Returns the distance from a level within which the scene decides its texture. `error_world`: 0 if it is not known.
[[nodiscard]] double texture_reach(double error_world, double scale_world, double voxel);
/// Returns the part of the scene that decides the texture of a tile with these voxels.
[[nodiscard]] Bounds3d texture_bounds(const VoxelBox& box, const GridFrame& frame, double scale_world);

/// Lengths of a level, scene units.
struct LevelLengths {
  double error = 0;        ///< largest distance to the scene; 0: not known
  double asked_error = 0;  ///< 0: none
  double scale = 0;
};
/// Returns the texture of a level. The largest of its error, its voxels and the error that was asked for decides how
/// fine it is: a level whose faces happen to lie on the scene is still not meant for near views. `memory`: for the
/// image.
[[nodiscard]] std::shared_ptr<const MeshTexture> level_texture(const Build& build, const LodScene& scene,
                                                               const LatticeMesh& mesh, const LevelLengths& level,
                                                               const SceneLooks& looks, const MemoryShare& memory);

/// Gives each level its texture, if the scene has looks to bake (LodScene::textured). Notes tell which images cannot be
/// used.
void bake_levels(Build& build, const LodScene& scene, CompleteLevels& made);

}  // namespace bp
