#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/core/box.h"
#include "lib/core/triangle_source.h"
#include "lib/grid/cells.h"
#include "lib/levels/level_request.h"

/// What a tileset is made of, as far as the bounds of the scene tell: nothing here needs a voxel.
namespace bp {

/// A level that is cut into tiles.
struct CutLevel {
  LodTarget target;  ///< of each tile
  GridFrame frame;
  double scale_world = 0;
  Halo halo;             ///< of the closing
  CellSpan cells;        ///< of all tiles; there are none where the closing has no voxel
  std::uint64_t number;  ///< of the first cell: jobs are numbered level by level, in the order of cells
  [[nodiscard]] std::uint64_t number_of(CellCoord cell) const { return number + cells.index(cell); }
};

/// Jobs of a tileset by their numbers in the plan: [begin, end).
struct JobRange {
  std::uint64_t begin = 0, end = 0;
  /// Whether one of `count` numbers from `first` on lies in it.
  [[nodiscard]] bool meets(std::uint64_t first, std::uint64_t count) const {
    return first < end && begin < first + count && begin < end;
  }
};

struct TilesetPlan {
  /// Closing radius of a level that is cut, in its voxels, if nobody says.
  static constexpr double kScaleVox = 2 + kBeyondWholeVox;
  /// Levels below the finest whose longest side has no more voxels are not cut, however small the tiles: so few voxels,
  /// closed at a scale of two of them, show less of a scene than the same number of faces does (decision 0013).
  static constexpr std::int64_t kWholeVox = 128;
  std::vector<CutLevel> cut;  ///< finest first
  StreamHeader uncut;         ///< of the solid after the last of them
  std::size_t whole = 0;      ///< levels in one mesh that follow; together they are one job, the last
  /// Numbers that jobs may have: 0 to one less.
  [[nodiscard]] std::uint64_t jobs() const { return whole_number() + (whole > 0 ? 1 : 0); }
  [[nodiscard]] std::uint64_t whole_number() const {
    return cut.empty() ? 0 : cut.back().number + cut.back().cells.count();
  }
};

/// header: of the solid, aligned to the cells.
[[nodiscard]] TilesetPlan plan_tileset(const LevelRequest& request, Cells cells, const StreamHeader& header);

/// How many levels it takes that the coarsest is not cut, whatever was asked for.
[[nodiscard]] std::size_t levels_to_one_mesh(LevelRequest request, Cells cells, const StreamHeader& header);

/// Reach of the closing at a scale that is the same everywhere.
[[nodiscard]] Halo halo_at(double scale_world, const GridFrame& frame);

// Where the surface of a scene lies, roughly: what the work of each job is estimated from.

/// Neighbours in the scene's order.
struct SurfaceRun {
  Bounds3d bounds;
  double area = 0;    ///< of all triangles, scene units squared
  double extent = 0;  ///< the sides of their boxes, scene units
};

/// Of at most 64 triangles each.
[[nodiscard]] std::vector<SurfaceRun> surface_runs(std::span<const TriangleD> triangles);

/// Keeps at most 2^16 runs: 4 MB. The same scene gives the same map.
class SurfaceMap {
 public:
  void add(std::span<const SurfaceRun> runs);
  [[nodiscard]] const SurfaceRun& all() const { return all_; }
  /// Of each job, by its number: faces of voxels that its share of the surface takes, about. A run's area counts evenly
  /// in its box.
  [[nodiscard]] std::vector<double> work(const TilesetPlan& plan, Cells cells) const;

 private:
  SurfaceRun all_;
  std::vector<SurfaceRun> runs_;
  std::uint64_t grain_ = 1;  ///< runs that were added, in each that is kept but the last
  std::uint64_t last_ = 0;   ///< in the last
};

}  // namespace bp
