#pragma once
#include "lib/device/backend.h"
#include "lib/levels/tiles/level_tiles.h"
#include "lib/levels/tiles/tile_plan.h"
#include "lib/pass/close/cell_closing.h"
#include "lib/pass/context.h"

/// The levels of a scene that are too large for one mesh: level n has the voxels of the solid reduced n times, closed,
/// and cut into tiles (level_tiles.h). What the scene shows to the outside is reduced along, so that errors are
/// measured against the scene and not against the level before.
namespace bp {

struct PyramidOptions {
  Cells cells;
  ClosingParams closing;
  PassContext context;  ///< results: closings and tiles
};

class TilePyramid {
 public:
  /// Begins at level 0. `solid` holds the bricks of `header`, whose frame is aligned_to_cells(). Keeps a reference to
  /// `backends`. Throws bad_input if the solid is empty.
  TilePyramid(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
              PyramidOptions options);

  [[nodiscard]] const StreamHeader& header() const { return header_; }  ///< of the level's solid
  [[nodiscard]] BrickShelf& solid() { return *solid_; }
  [[nodiscard]] std::size_t level() const { return level_; }
  [[nodiscard]] const std::vector<TileTask>& tasks() const { return tasks_; }  ///< of levels that were added

  /// Closes the level, and has its tiles made along with those of other levels; sets scale and element of
  /// `params`. Each level at most once. As close_cells().
  void add_level(double scale_world, TileParams params, TileEncoder encode, std::function<void(LevelTile&&)> consume);
  /// Of the levels that were added, whose voxels go then. `left`: as of bp::make_tiles().
  void make_tiles(const std::function<void(double)>& left = {});
  void reduce();  ///< to the next level

  /// What a LodChain goes on with; ends this pyramid.
  [[nodiscard]] std::unique_ptr<BrickShelf> take_solid() { return std::move(solid_); }
  [[nodiscard]] std::unique_ptr<BrickShelf> take_surface() { return std::move(surface_); }

 private:
  [[nodiscard]] std::unique_ptr<BrickShelf> closing_at(double scale_world);
  /// A level whose tiles are to be made.
  struct Waiting {
    std::unique_ptr<BrickShelf> closing;
    std::unique_ptr<BrickShelf> solid, surface;  ///< after reduce()
  };
  StreamHeader header_;
  std::unique_ptr<BrickShelf> solid_, surface_;
  std::vector<Waiting> waiting_;
  std::vector<TileTask> tasks_;
  bool added_ = false;     ///< the level is among waiting_
  std::size_t level_ = 0;  ///< how often it was reduced
  Backends& backends_;
  PyramidOptions options_;
};

}  // namespace bp
