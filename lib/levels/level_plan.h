#pragma once
#include "lib/levels/tiles/tile_plan.h"

/// What a run will make, as far as the triangles of the scene tell: nothing here needs a voxel.
namespace bp {

/// Of a level in one mesh, voxel and scale are those that are tried first.
struct PlannedLevel {
  double voxel = 0, scale_world = 0;
  std::int32_t halo_vox = 0;  ///< reach of the closing
  std::uint64_t tiles = 1;    ///< at most
  std::uint64_t number = 0;   ///< of the first job
  std::uint64_t faces = 0;    ///< of all tiles, about; 0: as few as the error takes
  bool cut = false;
};

/// Triangles of the dense surface of the scene's outside, about. It is not much larger than the sides of the bounds,
/// however much lies within. `area`: of all triangles.
[[nodiscard]] std::uint64_t planned_dense_faces(double area, const Bounds3d& bounds, double voxel);

/// The levels of a chain; `area`: of the scene's triangles. keep_voxels: as in LodTarget, of the first.
[[nodiscard]] std::vector<PlannedLevel> planned_chain(const LevelRequest& request, const StreamHeader& header,
                                                      double area, bool keep_voxels);
/// The levels of a tileset; `header`: of the first level.
[[nodiscard]] std::vector<PlannedLevel> planned_tileset(const TilesetPlan& plan, const LevelRequest& request,
                                                        const StreamHeader& header, double area);

}  // namespace bp
