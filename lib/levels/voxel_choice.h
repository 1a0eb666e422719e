#pragma once
#include "lib/levels/level_request.h"

/// The edge of the voxels that levels of detail are made of.
namespace bp {

/// Voxels along the longest side, where they are chosen.
constexpr std::int64_t kDefaultResolution = 256, kMostResolution = 1024, kMostTilesetResolution = 4096;
constexpr std::int64_t kOccluderResolution = 512;  ///< an occluder gives away a voxel or two of each wall
constexpr std::uint64_t kTilesetFaces = 40000;  ///< over the bounds, at most, that voxels of a tileset are chosen for

/// What is known of a scene before it is voxelized.
struct SceneSize {
  Bounds3d bounds;
  std::uint64_t triangles = 0;
  std::uint64_t without_area = 0;  ///< of these
};

enum class VoxelUse { meshes, tiles, occluder };

/// What is asked of the voxels. At most one of voxel and resolution is given.
struct VoxelRequest {
  double voxel = 0;             ///< edge, scene units; 0: not given
  std::int64_t resolution = 0;  ///< voxels along the longest side; 0: not given
  VoxelUse use = VoxelUse::meshes;
};
[[nodiscard]] inline bool is_named(const VoxelRequest& r) {
  return r.voxel > 0 || r.resolution > 0;
}

/// The edge of a voxel, scene units. `levels` comes from with_defaults(), but for tiles. The first of these that is
/// there decides:
///   - the voxel or the resolution that is asked for;
///   - an eighth of the finest error;
///   - kOccluderResolution, of an occluder;
///   - the faces of the finest level, at most four for each triangle of the scene: a surface as large as that of the
///     bounds has 190 triangles for each, and at least kLeastDenseFaces, within
///     kDefaultResolution and kMostResolution;
///   - for tiles without a budget: the triangles of the scene, at most kTilesetFaces. The cube as large as the bounds
///     has kDensePerFace triangles for each. The most is kMostTilesetResolution;
///   - kDefaultResolution.
[[nodiscard]] double chosen_voxel(const VoxelRequest& voxels, const LevelRequest& levels, const SceneSize& scene);

/// Of the six sides of a box.
[[nodiscard]] double area_of(const Bounds3d& bounds);

}  // namespace bp
