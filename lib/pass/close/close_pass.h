#pragma once
#include "lib/device/backend.h"
#include "lib/grid/stream.h"
#include "lib/pass/context.h"

/// bpclose's work: a stream of solid bricks in, the same bricks and their closing out, tile by tile, out of core.
///
/// Bricks are put on a shelf as they arrive. A tile is closed, by any idle backend, as soon as its halo has arrived;
/// tiles with nothing in reach are never visited. Then the cavities that the outside cannot reach are filled, over all
/// tiles, and both layers leave in slab order. With keep_cavities they leave while the input still arrives. Tile size,
/// memory and threads change no voxel.
namespace bp {

struct CloseOptions {
  std::int32_t tile_vox = 0;   ///< 0: by memory, halo and number of backends; else a multiple of 64
  bool keep_cavities = false;  ///< leave empty what the closing encloses
  PassContext context;         ///< two shelves are made: solid and closing
};

/// Where the time went, in seconds, summed over the threads at work.
struct CloseTimes {
  double reading = 0;    ///< waiting for bricks and shelving them; one thread at a time
  double waiting = 0;    ///< for an idle backend
  double closing = 0;    ///< in Backend: from the shelf to the closed tile, copies to and from a GPU included
  double labelling = 0;  ///< of the empty components of each tile
  double shelving = 0;   ///< closed tiles
  double filling = 0;    ///< cavities
  double writing = 0;    ///< one thread at a time
};

struct CloseCounts {
  std::int32_t tile_vox = 0;
  std::uint64_t tiles = 0;                             ///< of the grid
  std::uint64_t tiles_closed = 0;                      ///< visited: with solid bricks in reach
  std::int32_t halo_vox = 0;                           ///< largest of any visited tile
  std::uint64_t solid_bricks = 0, closing_bricks = 0;  ///< written
  std::uint64_t cavity_voxels = 0;                     ///< enclosed by the closing, and filled
  CloseTimes seconds;
  std::uint64_t ignored_bricks = 0;  ///< of a closing layer in the input: it is made anew from the solid layer
};

/// Bricks that the closing of a stream can touch: the stream's own, grown by the largest scale and one more voxel, so
/// that the outside surrounds it. Coordinates may become negative. Same longest axis. Throws bad_argument if a scale is
/// out of range, or if the grid leaves the 32-bit voxel coordinates.
[[nodiscard]] BrickBox closing_bricks(const StreamHeader& header, const ScaleField& scale,
                                      const ClosingParams& params = {});

/// Reads `source` to its end (a closing layer in it is passed over: the closing is made from the solid layer) and
/// writes both layers to `sink`; the caller calls finish(). The sink's header is the source's with bricks =
/// closing_bricks(), has_closing, scale and element set. Throws bad_argument if tile_vox will not do or a scale is out
/// of range, out_of_resource if not even one tile fits in the memory.
CloseCounts close_stream(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& scale,
                         const ClosingParams& params, const CloseOptions& options);

/// The same of voxels on a shelf, with bricks of `header`: the closing, on a new shelf.
[[nodiscard]] std::unique_ptr<BrickShelf> close_shelf(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                                      const ScaleField& scale, const ClosingParams& params,
                                                      const CloseOptions& options);

}  // namespace bp
