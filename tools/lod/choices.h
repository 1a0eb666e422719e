#pragma once
#include "lib/levels/voxel_choice.h"
#include "tools/lod/build_options.h"
#include "tools/run/provenance.h"

/// Derives from the options of bplod, and from the scene, everything that the options leave open.
namespace bp {

/// Returns the request of the options, in scene units. Without the scene's diagonal and voxel, only its numbers and the
/// lengths of its lists are right.
[[nodiscard]] LevelRequest request_of(const BuildOptions& options, double diagonal = 1, double voxel = 1);

/// Returns the request for a scene of `triangles`, completed with the profile's defaults (with_defaults()); those of
/// tilesets and occluders stay as they are. `voxel`: the scene's, since --scale may be given in voxels.
[[nodiscard]] LevelRequest request_for(const BuildOptions& options, std::uint64_t triangles, double diagonal,
                                       double voxel = 1);

/// Returns the edge of a voxel, scene units: chosen_voxel() of these options.
[[nodiscard]] double voxel_size(const BuildOptions& options, const SceneSize& scene);
[[nodiscard]] VoxelRequest voxel_request(const BuildOptions& options, double diagonal);

/// Returns whether the scene alone decides the voxels of a tileset, since no voxels, error or faces are given.
[[nodiscard]] bool is_by_scene(const BuildOptions& options);

/// Returns whether the scene consists of files, which can be read several times.
[[nodiscard]] bool can_read_again(const BuildOptions& options);

/// Returns whether the scene may be read once more while its voxels are in memory: for its triangles, textures or rules
/// of --field.
[[nodiscard]] bool may_read_again(const BuildOptions& options);

/// Returns whether the scene's own triangles may be what levels enclose: bounding levels that are no cages.
[[nodiscard]] bool may_enclose_scene(const BuildOptions& options);
/// Returns the least distance of the levels from the scene, scene units. `voxel`: the scene's voxel.
[[nodiscard]] double margin_of(const BuildOptions& options, double diagonal, double voxel);
/// Returns what levels of a scene of `triangles` enclose. The option decides. Without it, they enclose the triangles if
/// may_enclose_scene(), if the scene can be read again, and if it has at most kMostEnclosedTriangles; else the voxels.
/// The memory does not decide, since it must not change the result.
[[nodiscard]] Enclose enclosed_by(const BuildOptions& options, std::uint64_t triangles);

/// Returns the options of a level, for its provenance. `enclosed`: the result of enclosed_by().
[[nodiscard]] OptionText option_text(const BuildOptions& options, Enclose enclosed, const LodTarget& target,
                                     std::size_t level, double scale_world, const GridFrame& frame);

/// Refuses options that --mode visual has no use for. Throws bad_argument.
void check_visual(const Args& args, const BuildOptions& options);

}  // namespace bp
