#pragma once
#include "lib/device/backend.h"
#include "lib/grid/cells.h"
#include "lib/grid/stream.h"
#include "lib/pass/context.h"

/// The closing of a level, cell by cell. Each cell is a job whose result can be kept: it depends on the voxels in the
/// cell and its halo, on the scale and the element, but not on where the cell lies. The voxels are those of
/// close_stream().
namespace bp {

struct CellClosing {
  Cells cells;
  ClosingParams closing;
  bool keep_cavities = false;
  PassContext context;
};

struct CellClosingCounts {
  std::uint64_t cells = 0, kept = 0;  ///< cells with solid voxels in reach; number of these that the store had
};

/// Returns the bytes that one cell takes, where little of it is occupied. halo_vox: Halo::total_vox() of the closing.
[[nodiscard]] std::uint64_t least_cell_bytes(const Cells& cells, std::int32_t halo_vox);

/// Puts the closing of `solid`, with bricks of `header`, onto `closing`. `scale_world` is the same everywhere. Throws
/// as close_stream() does; out_of_resource if not even one cell fits in the memory.
CellClosingCounts close_cells(const StreamHeader& header, const BrickShelf& solid, Backends& backends,
                              double scale_world, const CellClosing& options, BrickShelf& closing);

}  // namespace bp
