#pragma once
#include "lib/device/backend.h"
#include "lib/levels/tiles/level_tiles.h"
#include "lib/pass/close/cell_closing.h"
#include "lib/pass/context.h"

/// Makes the levels of a scene that are too large for one mesh. Level n has the voxels of the solid reduced n times,
/// closed, and cut into tiles (level_tiles.h). The voxels that the scene shows to the outside are reduced, too, so that
/// errors are measured against the scene and not against the level before.
namespace bp {

struct PyramidOptions {
  Cells cells;
  ClosingParams closing;
  PassContext context;  ///< its results keep closings and tiles
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
  [[nodiscard]] const PassContext& context() const { return options_.context; }

  /// Closes the current level at params.scale_world, and adds it to tasks(). Sets the element of `params`. Call it at
  /// most once for each level. Throws as close_cells().
  void add_level(TileParams params);
  void drop_tasks();  ///< frees the voxels of all added levels
  void reduce();      ///< goes on to the next level

  /// Return the layers from which a LodChain goes on. The pyramid must not be used afterwards.
  [[nodiscard]] std::unique_ptr<BrickShelf> take_solid() { return std::move(solid_); }
  [[nodiscard]] std::unique_ptr<BrickShelf> take_surface() { return std::move(surface_); }

 private:
  /// The voxels of an added level whose tiles are not made yet.
  struct Waiting {
    std::unique_ptr<BrickShelf> closing;
    std::unique_ptr<BrickShelf> solid, surface;  ///< are set by reduce()
  };
  StreamHeader header_;
  std::unique_ptr<BrickShelf> solid_, surface_;
  std::vector<Waiting> waiting_;
  std::vector<TileTask> tasks_;
  bool added_ = false;     ///< the current level was added
  std::size_t level_ = 0;  ///< how often the solid was reduced
  Backends& backends_;
  PyramidOptions options_;
};

}  // namespace bp
