#pragma once
#include "lib/levels/tiles/level_tiles.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

/// One tile: see level_tiles.h.
class TileMaker {
 public:
  /// Keeps references.
  TileMaker(const TileTask& task, CellCoord coord, const PassContext& context)
      : level_(task.level),
        params_(task.params),
        context_(context),
        coord_(coord),
        cell_(level_.cells.box(coord)),
        grown_(cell_.grown(1)) {}

  /// Everything that the tile depends on.
  [[nodiscard]] ResultKey key() const;
  /// False for a cell in a cavity that the closing filled: no voxel of the scene, and nothing to be seen.
  [[nodiscard]] bool begin();
  /// After begin(), if that was true.
  [[nodiscard]] LatticeMesh make(TileMeasures& measures);

 private:
  void take_scene();
  void leave_out_fringes();
  void hold_stray_parts();
  void hold_beside_triangles();
  [[nodiscard]] LatticeMesh mesh_cell(TileMeasures& measures, MeshCounts& counts) const;
  [[nodiscard]] MeshParams mesh_params(TileMeasures& measures) const;
  [[nodiscard]] StreamHeader header() const;
  [[nodiscard]] Bounds3d world(const VoxelBox& box, std::int64_t by = 0) const;
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
  std::vector<TriangleD> scene_;      // whose parts in the cell stay inside, or that a fit is drawn to
  std::unique_ptr<BrickShelf> held_;  // what stays inside besides those; without any the solid does
  Boundary boundary_;                 // of the solid
};

}  // namespace bp
