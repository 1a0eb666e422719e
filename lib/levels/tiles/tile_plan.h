#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/core/box.h"
#include "lib/core/triangle_source.h"
#include "lib/grid/cells.h"
#include "lib/levels/level_request.h"

/// Plans a tileset from the bounds of the scene alone, before there are voxels.
namespace bp {

/// A level that is cut into tiles.
struct CutLevel {
  LodTarget target;  ///< of each tile
  GridFrame frame;
  double scale_world = 0;
  Halo halo;             ///< halo of the closing
  CellSpan cells;        ///< the cells of all tiles; a cell without voxels of the closing gets no tile
  std::uint64_t number;  ///< number of the first cell's job: jobs are numbered level by level, in the order of cells
  [[nodiscard]] std::uint64_t number_of(CellCoord cell) const { return number + cells.index(cell); }
};

/// A range of the tileset's jobs, by their numbers in the plan: [begin, end).
struct JobRange {
  std::uint64_t begin = 0, end = 0;
  /// Returns whether one of the `count` numbers from `first` on lies in the range.
  [[nodiscard]] bool meets(std::uint64_t first, std::uint64_t count) const {
    return first < end && begin < first + count && begin < end;
  }
};

struct TilesetPlan {
  /// Closing radius of a cut level, in its voxels, if the user gives none.
  static constexpr double kScaleVox = 2 + kBeyondWholeVox;
  /// A level below the finest is not cut if its longest side has at most this many voxels, even if cells are smaller:
  /// closed at two voxels, it shows less of a scene than one mesh of the same number of faces does (decision 0013).
  static constexpr std::int64_t kWholeVox = 128;
  std::vector<CutLevel> cut;  ///< finest first
  StreamHeader uncut;         ///< header of the solid of the first level that is not cut
  std::size_t whole = 0;      ///< number of levels that follow as one mesh each; together they are the last job
  /// Returns the number of jobs.
  [[nodiscard]] std::uint64_t jobs() const { return whole_number() + (whole > 0 ? 1 : 0); }
  [[nodiscard]] std::uint64_t whole_number() const {
    return cut.empty() ? 0 : cut.back().number + cut.back().cells.count();
  }
};

/// header: the header of the solid, aligned to the cells.
[[nodiscard]] TilesetPlan plan_tileset(const LevelRequest& request, Cells cells, const StreamHeader& header);

/// Returns how many levels it takes until one is not cut, independent of the number that was asked for.
[[nodiscard]] std::size_t levels_to_one_mesh(LevelRequest request, Cells cells, const StreamHeader& header);

/// Returns the halo of a closing whose scale is the same everywhere.
[[nodiscard]] Halo halo_at(double scale_world, const GridFrame& frame);

// Estimates of the work of each job, from the places of a scene's surface.

/// A run of triangles that follow each other in the scene's order.
struct SurfaceRun {
  Bounds3d bounds;
  double area = 0;    ///< of all triangles, scene units squared
  double extent = 0;  ///< the sum of the sides of the triangles' boxes, scene units
};

/// Returns runs of at most 64 triangles each.
[[nodiscard]] std::vector<SurfaceRun> surface_runs(std::span<const TriangleD> triangles);

/// Keeps the surface of a scene as at most 2^16 runs (4 MB), merging neighbours if there are more. The same scene gives
/// the same map.
class SurfaceMap {
 public:
  void add(std::span<const SurfaceRun> runs);
  [[nodiscard]] const SurfaceRun& all() const { return all_; }
  /// Estimates the work of each job, by its number: how many voxel faces its part of the surface has. A run's area
  /// counts as spread evenly over the run's box.
  [[nodiscard]] std::vector<double> work(const TilesetPlan& plan, Cells cells) const;

 private:
  SurfaceRun all_;
  std::vector<SurfaceRun> runs_;
  std::uint64_t grain_ = 1;  ///< number of added runs that each kept run holds, except the last one
  std::uint64_t last_ = 0;   ///< number of added runs in the last one
};

}  // namespace bp
