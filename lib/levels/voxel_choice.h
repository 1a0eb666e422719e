#pragma once
#include "lib/core/grid_frame.h"
#include "lib/levels/level_request.h"

/// Chooses the edge of the voxels that levels of detail are made of.
namespace bp {

/// Voxels along the longest side.
constexpr std::int64_t kDefaultResolution = 256;
constexpr std::int64_t kMostResolution = 4 * kDefaultResolution, kMostTilesetResolution = 16 * kDefaultResolution;
/// Finer than the default, since an occluder gives away one or two voxels at each wall.
constexpr std::int64_t kOccluderResolution = 2 * kDefaultResolution;
/// The most faces over the bounds that the voxels of a tileset are chosen for.
constexpr std::uint64_t kTilesetFaces = 40000;

/// The facts about a scene that are known before it is voxelized.
struct SceneSize {
  Bounds3d bounds;
  std::uint64_t triangles = 0;
  std::uint64_t without_area = 0;  ///< how many of the triangles have no area
};

enum class VoxelUse { meshes, tiles, occluder };

/// The user's wishes for the voxels. At most one of voxel and resolution is given.
struct VoxelRequest {
  double voxel = 0;             ///< edge, scene units; 0: not given
  std::int64_t resolution = 0;  ///< voxels along the longest side; 0: not given
  VoxelUse use = VoxelUse::meshes;
};
[[nodiscard]] inline bool is_named(const VoxelRequest& r) {
  return r.voxel > 0 || r.resolution > 0;
}

/// Returns the edge of a voxel, scene units. `levels` comes from with_defaults(), except for tiles. The first of these
/// that applies decides:
///   - the voxel or the resolution that is asked for;
///   - an eighth of the finest error;
///   - for an occluder, kOccluderResolution;
///   - the faces of the finest level, at most four for each triangle of the scene. A surface as large as that of the
///     bounds gets 190 dense triangles for each face, and at least kLeastDenseFaces, within kDefaultResolution and
///     kMostResolution;
///   - for tiles without a budget, the triangles of the scene, at most kTilesetFaces. The cube of the same volume as
///     the bounds gets kDensePerFace dense triangles for each. The most is kMostTilesetResolution;
///   - kDefaultResolution.
[[nodiscard]] double chosen_voxel(const VoxelRequest& voxels, const LevelRequest& levels, const SceneSize& scene);

/// Returns the area of the six sides of a box.
[[nodiscard]] double area_of(const Bounds3d& bounds);

/// Returns a box of voxels in scene units, grown by so many lattice units.
[[nodiscard]] Bounds3d bounds_of(const VoxelBox& box, const GridFrame& frame, std::int64_t by = 0);

}  // namespace bp
