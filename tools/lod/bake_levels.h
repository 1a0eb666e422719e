#pragma once
#include <memory>
#include <vector>

#include "lib/pass/bake/scene_looks.h"
#include "tools/lod/scene/lod_scene.h"

/// Textures of levels, from those of the scene.
namespace bp {

/// Reads the scene once more. `memory`: for what is at work of its triangles and images.
[[nodiscard]] std::unique_ptr<SceneLooks> read_looks(const Build& build, const LodScene& scene,
                                                     const MemoryShare& memory);

/// What decides how fine the texture of a level is: its error, or what stands for it if that is 0: not known.
[[nodiscard]] double error_or(double error_world, double scale_world, double voxel);

/// Texels of all textures of a level, about. `error_world`: as error_or(), or 0: the faces decide.
[[nodiscard]] double planned_texels(double faces, const Bounds3d& bounds, double error_world);

/// So far from a level lies what decides its texture; `error_world` as below.
[[nodiscard]] double texture_reach(double error_world, double scale_world, double voxel);
/// Returns the part of the scene that decides the texture of a tile with these voxels.
[[nodiscard]] Bounds3d texture_bounds(const VoxelBox& box, const GridFrame& frame, double scale_world);

/// Lengths of a level, scene units.
struct LevelLengths {
  double error = 0;        ///< largest distance to the scene; 0: not known
  double asked_error = 0;  ///< 0: none
  double scale = 0;
};
/// The texture of a level. Of its error, its voxels and the error that was asked for, the largest decides how fine it
/// is: a level whose faces happen to lie on the scene is not meant for nearer views. `memory`: for the image.
[[nodiscard]] std::shared_ptr<const MeshTexture> level_texture(const Build& build, const LodScene& scene,
                                                               const LatticeMesh& mesh, const LevelLengths& level,
                                                               const SceneLooks& looks, const MemoryShare& memory);

/// Gives each level its texture, if the scene has any (LodScene::textured). Notes tell of images that cannot be used.
void bake_levels(Build& build, const LodScene& scene, CompleteLevels& made);

}  // namespace bp
