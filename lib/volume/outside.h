#pragma once
#include <memory>
#include <vector>

#include "lib/grid/bit_box.h"

/// Which empty voxels the outside can reach: connected components of the empty voxels (6-neighbours), over all tiles,
/// by union-find over the components of each tile. Global and out of core; the same for every tiling. The outside of
/// the grid is empty.
namespace bp {

/// Usage: label() each tile (parallel, any thread), join() the results in any order on one thread, then resolve(); then
/// fill_enclosed() sets, in a tile's bits, the empty voxels that the outside cannot reach. A tile that is never joined
/// counts as empty, so that tiles without voxels cost nothing.
///
/// Memory: four bytes per component that touches its tile's faces, plus the run-length coded labels of the faces whose
/// other side has not been joined yet. Components inside a tile never leave it.
class OutsideFlood {
 public:
  /// `grid` is cut into tiles of `tile_vox` voxels, counted from grid.min, the last ones cut off at grid.max. Fastest
  /// where tiles begin at multiples of 64 in x. Throws bad_argument if the grid has 2^62 tiles or more, or a tile face
  /// 2^32 voxels or more.
  OutsideFlood(const VoxelBox& grid, VoxelCoord tile_vox);
  ~OutsideFlood();
  OutsideFlood(const OutsideFlood&) = delete;
  OutsideFlood& operator=(const OutsideFlood&) = delete;

  struct TileLabels;  ///< components of the empty voxels of one tile: their number, and the labels along its six faces
  struct ReleaseLabels {
    void operator()(TileLabels* labels) const;
  };
  using Labels = std::unique_ptr<TileLabels, ReleaseLabels>;
  /// `solid` must hold the tile. Cost: one pass over its words and runs. Thread-safe.
  [[nodiscard]] static Labels label(const BitBox& solid, const VoxelBox& tile);
  /// A tile with no occupied voxel: one component. Optional: it only frees the neighbours' face labels earlier.
  [[nodiscard]] static Labels label_empty(const VoxelBox& tile);

  void join(Labels labels);  ///< each tile at most once; releases face labels as soon as no neighbour needs them
  void resolve();            ///< after the last join()

  /// True if some empty voxel of the tile is enclosed; cheap. True for a whole empty tile that is enclosed, joined or
  /// not. Thread-safe.
  [[nodiscard]] bool has_enclosed(const VoxelBox& tile) const;
  /// Sets the enclosed voxels of `tile` in `solid`, which must be as it was when labelled. Returns their number.
  /// Thread-safe.
  std::uint64_t fill_enclosed(const VoxelBox& tile, BitBox& solid) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
