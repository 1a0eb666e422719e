#pragma once
#include "lib/device/backend.h"
#include "lib/grid/stream.h"
#include "lib/pass/close/earlier_closing.h"
#include "lib/pass/context.h"

/// The work of bpclose: solid bricks come in, and the same bricks and their closing go out, tile by tile, out of core.
///
/// Bricks are put on a shelf as they arrive. A tile is closed, by any idle backend, as soon as its halo has arrived;
/// tiles with nothing in reach are never visited. Then cavities that the outside cannot reach are filled, over all
/// tiles, and both layers leave in slab order. With keep_cavities they leave while the input still arrives. Tile size,
/// memory and threads change no voxel.
namespace bp {

struct CloseOptions {
  std::int32_t tile_vox = 0;   ///< 0: chosen by memory, halo and number of backends; else a multiple of 64
  bool keep_cavities = false;  ///< cavities that the closing encloses stay empty
  PassContext context;         ///< it makes two shelves: solid and closing
  /// Tiles in whose reach no scale has changed are taken from it; null: all tiles are closed. It changes no voxel.
  const EarlierClosing* earlier = nullptr;
  BrickShelf* filled = nullptr;  ///< gets the voxels of cavities that are filled; may be null
};

/// Where the time went, in seconds, summed over the threads at work.
struct CloseTimes {
  double reading = 0;    ///< waiting for bricks and shelving them; one thread at a time
  double waiting = 0;    ///< waiting for an idle backend
  double closing = 0;    ///< in Backend: from the shelf to the closed tile, copies to and from a GPU included
  double labelling = 0;  ///< labelling the empty components of each tile
  double shelving = 0;   ///< putting closed tiles on the shelf
  double filling = 0;    ///< filling cavities
  double writing = 0;    ///< writing bricks; one thread at a time
};

struct CloseCounts {
  std::int32_t tile_vox = 0;
  std::uint64_t tiles = 0;                             ///< in the grid
  std::uint64_t tiles_closed = 0;                      ///< visited, with solid bricks in reach, and closed anew
  std::int32_t halo_vox = 0;                           ///< the largest of any visited tile
  std::uint64_t solid_bricks = 0, closing_bricks = 0;  ///< written
  std::uint64_t cavity_voxels = 0;                     ///< voxels that the closing encloses, and that were filled
  CloseTimes seconds;
  /// Number of closing bricks in the input that were ignored, since the closing is made anew from the solid layer.
  std::uint64_t ignored_bricks = 0;
};

/// Returns the bricks that the closing of a stream can touch: the stream's own, grown by the largest scale and one more
/// voxel, so that the outside surrounds it. Coordinates may become negative. The longest axis stays the same. Throws
/// bad_argument if a scale is out of range, or if the grid leaves the 32-bit voxel coordinates.
[[nodiscard]] BrickBox closing_bricks(const StreamHeader& header, const ScaleField& scale,
                                      const ClosingParams& params = {});

/// Reads `source` to its end and writes both layers to `sink`; the caller calls finish(). A closing layer in the source
/// is ignored. The sink's header is the source's with bricks = closing_bricks(), has_closing, scale and element set.
/// Throws bad_argument if tile_vox is not allowed or a scale is out of range, out_of_resource if not even one tile fits
/// in the memory.
CloseCounts close_stream(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& scale,
                         const ClosingParams& params, const CloseOptions& options);

/// Closes voxels on a shelf, with bricks of `header`. Returns the closing on a new shelf.
[[nodiscard]] std::unique_ptr<BrickShelf> close_shelf(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                                      const ScaleField& scale, const ClosingParams& params,
                                                      const CloseOptions& options);

}  // namespace bp
