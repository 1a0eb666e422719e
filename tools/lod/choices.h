#pragma once
#include "lib/levels/voxel_choice.h"
#include "tools/lod/build_options.h"
#include "tools/run/provenance.h"

/// What follows from the options of bplod, and from the scene where they leave something open.
namespace bp {

/// In scene units, as given. Without a scene, only the numbers and the lengths of lists mean something.
[[nodiscard]] LevelRequest request_of(const BuildOptions& options, double diagonal = 1, double voxel = 1);

/// The levels for a scene of so many triangles: with_defaults() of the profile. Levels of a tileset follow from its
/// voxels instead. `voxel`: of the scene; --scale may be in voxels.
[[nodiscard]] LevelRequest request_for(const BuildOptions& options, std::uint64_t triangles, double diagonal,
                                       double voxel = 1);

/// Edge of a voxel, scene units: chosen_voxel() of these options.
[[nodiscard]] double voxel_size(const BuildOptions& options, const SceneSize& scene);
[[nodiscard]] VoxelRequest voxel_request(const BuildOptions& options, double diagonal);

/// Whether the scene alone decides the voxels of a tileset: no voxels, error or faces are given.
[[nodiscard]] bool is_by_scene(const BuildOptions& options);

/// Whether the scene is of files, which can be read any number of times.
[[nodiscard]] bool can_read_again(const BuildOptions& options);

/// Whether the scene may be read once more while its voxels are in memory: for its triangles, textures or field.
[[nodiscard]] bool may_read_again(const BuildOptions& options);

/// Whether levels are one mesh each, and the scene's own triangles may be what stays inside while they are tightened.
[[nodiscard]] bool may_enclose_scene(const BuildOptions& options);
/// Least distance of the levels from the scene, scene units; `voxel` of the scene.
[[nodiscard]] double margin_of(const BuildOptions& options, double diagonal, double voxel);
/// What stays inside the levels of a scene of so many triangles: as asked; else the triangles, where levels are one
/// mesh each and no cages, the scene can be read again, and it has no more than kMostEnclosedTriangles; else its
/// voxels. Memory has no say.
[[nodiscard]] Enclose enclosed_by(const BuildOptions& options, std::uint64_t triangles);

/// Of a level, for its provenance. `enclosed`: of enclosed_by().
[[nodiscard]] OptionText option_text(const BuildOptions& options, Enclose enclosed, const LodTarget& target,
                                     std::size_t level, double scale_world, const GridFrame& frame);

}  // namespace bp
