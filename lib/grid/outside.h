#pragma once
#include <memory>
#include <vector>

#include "lib/grid/bit_box.h"

/// Which empty voxels the outside can reach: connected components of the empty voxels (6-neighbours), over all tiles,
/// by union-find over the components of each tile. Global and out of core; the same for every tiling. The outside of
/// the grid is empty.
namespace bp {

/// Usage: label() each tile (parallel, any thread), join() the results in any order on one thread, then resolve(); then
/// fill_enclosed() sets, in a tile's bits, the empty voxels that the outside cannot reach.
class OutsideFlood {
 public:
  /// `grid` is cut into tiles of `tile_vox` voxels (a multiple of 64), counted from grid.min, the last ones cut off at
  /// grid.max.
  OutsideFlood(const VoxelBox& grid, VoxelCoord tile_vox);
  ~OutsideFlood();

  struct TileLabels;  ///< components of the empty voxels of one tile: their number, and the labels along its six faces
  [[nodiscard]] static std::unique_ptr<TileLabels> label(const BitBox& solid, const VoxelBox& tile);
  /// A tile with no occupied voxel: one component.
  [[nodiscard]] static std::unique_ptr<TileLabels> label_empty(const VoxelBox& tile);

  void join(std::unique_ptr<TileLabels> labels);  ///< releases face labels as soon as no neighbour needs them
  void resolve();                                 ///< every tile was joined

  /// True if some empty voxel of the tile is enclosed; cheap.
  [[nodiscard]] bool has_enclosed(const VoxelBox& tile) const;
  /// Sets the enclosed voxels of `tile` in `solid`, which must be as it was when labelled. Returns their number.
  /// Thread-safe.
  std::uint64_t fill_enclosed(const VoxelBox& tile, BitBox& solid) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
