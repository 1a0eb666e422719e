#pragma once
#include <memory>
#include <mutex>
#include <string>

#include "io/stream/brick_stream.h"
#include "lib/grid/shelf_stream.h"
#include "tools/api/scene.h"
#include "tools/cli/options/voxel.h"

namespace bp::api {

class Call;

/// Voxels on shelves. Grids that follow from each other share shelves; nothing changes once a grid is made.
struct VoxelGrid {
  StreamHeader header;
  std::shared_ptr<BrickShelf> solid, closing;  ///< closing: null without that layer
  std::shared_ptr<const Scene> scene;          ///< that it was made from; null: of a file, whose header may name files

  /// Returns the stream of its bricks. It keeps a reference to this object.
  [[nodiscard]] ShelfSource open() const { return {header, *solid, closing.get(), ShelfSource::Keep::all}; }
  /// Opens the triangles of the scene's arrays; null if it is of files, which the header names, or not known.
  [[nodiscard]] std::unique_ptr<TriangleSource> open_arrays(const SceneOptions& options) const {
    return scene && scene->arrays ? scene->open(options) : nullptr;
  }
  /// Returns counts and checksum; computed once.
  [[nodiscard]] const StreamTotals& totals() const;
  /// Returns the scale field as JSON; empty if there is none. Computed once.
  [[nodiscard]] const std::string& rules() const;
  /// Returns the layer; null: the grid does not have it.
  [[nodiscard]] const BrickShelf* layer(std::int32_t layer) const;

 private:
  mutable std::once_flag counted_;
  mutable StreamTotals totals_;
  mutable std::once_flag written_;
  mutable std::string rules_;
};

/// Returns the options of the tools that say the same.
[[nodiscard]] VoxelOptions voxel_options(const Scene& scene, const bp_voxelize_options* options);

/// The steps of the pipe.
[[nodiscard]] std::shared_ptr<const VoxelGrid> voxelize(const std::shared_ptr<const Scene>& scene,
                                                        const bp_voxelize_options* options, Call& call);
[[nodiscard]] std::shared_ptr<const VoxelGrid> close(const VoxelGrid& grid, const bp_close_options* options,
                                                     Call& call);

}  // namespace bp::api

struct bp_grid {
  std::shared_ptr<const bp::api::VoxelGrid> grid;
};
