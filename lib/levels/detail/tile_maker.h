#pragma once
#include "lib/levels/tiles/tile_task.h"
#include "lib/pass/context.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

/// Makes one tile: see level_tiles.h.
class TileMaker {
 public:
  /// Keeps references to the task and the context.
  TileMaker(const TileTask& task, CellCoord coord, const PassContext& context)
      : level_(task.level),
        params_(task.params),
        context_(context),
        coord_(coord),
        cell_(level_.cells.box(coord)),
        grown_(cell_.grown(1)) {}

  /// Returns the key of the tile in the store of results. It covers everything that the tile depends on, so equal keys
  /// mean equal tiles. `inputs`: of the tile's file (TileJobs::get()).
  [[nodiscard]] ResultKey key(const ResultKey& inputs) const;
  /// Cuts out the cell's voxels. Returns false for a cell in a cavity that the closing filled: it holds no voxel of the
  /// scene, and nobody can see a face in it.
  [[nodiscard]] bool begin();
  /// Makes the mesh. begin() must have returned true.
  [[nodiscard]] LatticeMesh make(TileMeasures& measures);
  /// After begin(), in place of make(): returns the limit on memory at which the tile has enough. `triangles`: those
  /// near the cell that it encloses or follows, at most, while TileParams::scene is not there yet. Throws as
  /// mesh_limit().
  [[nodiscard]] std::uint64_t limit(std::uint64_t triangles) const;

 private:
  void take_scene();
  void leave_out_fringes();
  void hold_stray_parts();
  void hold_beside_triangles();
  [[nodiscard]] MeshParams mesh_params(TileMeasures& measures) const;
  [[nodiscard]] StreamHeader header() const;
  [[nodiscard]] Bounds3d grown_world() const;
  [[nodiscard]] std::vector<TriangleD> scene_nearby() const;
  [[nodiscard]] std::vector<TriangleD> shown() const;
  [[nodiscard]] VoxelBox reach() const;
  void measure(const LatticeMesh& mesh, TileMeasures& measures) const;

  const TileLevel& level_;
  const TileParams& params_;
  const PassContext& context_;
  const CellCoord coord_;
  const VoxelBox cell_, grown_;
  std::unique_ptr<BrickShelf> solid_, closing_;
  std::vector<TriangleD> scene_;  // bounding: these stay inside within the cell; fit: the mesh follows them
  // Must stay inside in addition to the triangles of a bounding tile; null for other tiles.
  std::unique_ptr<BrickShelf> held_;
  Boundary boundary_;  // the boundary of solid_
};

}  // namespace bp
