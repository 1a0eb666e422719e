#pragma once
#include "lib/levels/tiles/tile_plan.h"

/// Foresees the levels of a run from the triangles' bounds and area alone, before there are voxels.
namespace bp {

/// A level that will be made. If it is one mesh, voxel and scale are those that are tried first.
struct PlannedLevel {
  double voxel = 0, scale_world = 0;
  std::int32_t halo_vox = 0;  ///< reach of the closing, in voxels
  std::uint64_t tiles = 1;    ///< an upper bound
  std::uint64_t number = 0;   ///< number of the level's first job
  std::uint64_t faces = 0;    ///< of all tiles together, estimated; 0: as few as the error allows
  bool cut = false;
};

/// Estimates the triangles of the dense surface of the scene's outside. It is not much larger than the sides of the
/// bounds, even if much more lies inside. `area`: the area of all triangles.
[[nodiscard]] std::uint64_t planned_dense_faces(double area, const Bounds3d& bounds, double voxel);

/// Returns the levels of a chain. `area`: the area of the scene's triangles. keep_voxels: LodTarget::keep_voxels of the
/// first level.
[[nodiscard]] std::vector<PlannedLevel> planned_chain(const LevelRequest& request, const StreamHeader& header,
                                                      double area, bool keep_voxels);
/// Returns the levels of a tileset. `header`: the header of the first level.
[[nodiscard]] std::vector<PlannedLevel> planned_tileset(const TilesetPlan& plan, const LevelRequest& request,
                                                        const StreamHeader& header, double area);

}  // namespace bp
