#pragma once
#include <memory>
#include <vector>

#include "lib/grid/bit_box.h"

/// Finds the empty voxels that the outside can reach: connected components of the empty voxels (6-neighbours) over all
/// tiles, by union-find over the components of each tile. The result is global, and the same for every tiling; the work
/// is out of core. The outside of the grid is empty.
namespace bp {

/// Usage: label() each tile (parallel, any thread), join() the results in any order on one thread, then resolve(). Then
/// fill_enclosed() sets, in a tile's bits, the empty voxels that the outside cannot reach. A tile that is never joined
/// counts as empty, so tiles without voxels cost nothing.
///
/// Memory: four bytes per component that touches its tile's faces, plus the run-length coded labels of the faces whose
/// other side has not been joined yet. Components inside a tile never leave it.
class OutsideFlood {
 public:
  /// Cuts `grid` into tiles of `tile_vox` voxels, counted from grid.min; the last ones are cut off at grid.max. It is
  /// fastest if tiles begin at multiples of 64 in x. Throws bad_argument if the grid has 2^62 tiles or more, or a tile
  /// face 2^32 voxels or more.
  OutsideFlood(const VoxelBox& grid, VoxelCoord tile_vox);
  ~OutsideFlood();
  OutsideFlood(const OutsideFlood&) = delete;
  OutsideFlood& operator=(const OutsideFlood&) = delete;

  struct TileLabels;  ///< components of the empty voxels of one tile: their number, and the labels along its six faces
  struct ReleaseLabels {
    void operator()(TileLabels* labels) const;
  };
  using Labels = std::unique_ptr<TileLabels, ReleaseLabels>;
  /// Labels a tile, which `solid` must hold. Cost: one pass over its words and runs. Thread-safe.
  [[nodiscard]] static Labels label(const BitBox& solid, const VoxelBox& tile);
  /// Labels a tile without an occupied voxel: one component. Optional; it only frees the neighbours' face labels
  /// earlier.
  [[nodiscard]] static Labels label_empty(const VoxelBox& tile);

  void join(Labels labels);  ///< takes each tile at most once; releases face labels as soon as no neighbour needs them
  void resolve();            ///< call it after the last join()

  /// Returns true if some empty voxel of the tile is enclosed; cheap. True also for a whole empty tile that is
  /// enclosed, joined or not. Thread-safe.
  [[nodiscard]] bool has_enclosed(const VoxelBox& tile) const;
  /// Sets the enclosed voxels of `tile` in `solid`, which must be as it was when labelled. Returns their number.
  /// Thread-safe.
  std::uint64_t fill_enclosed(const VoxelBox& tile, BitBox& solid) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
