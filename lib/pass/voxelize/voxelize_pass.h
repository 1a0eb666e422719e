#pragma once
#include <functional>
#include <optional>

#include "lib/core/triangle_source.h"
#include "lib/device/backend.h"
#include "lib/grid/stream.h"
#include "lib/pass/context.h"
#include "lib/pass/voxelize/stray_part.h"

/// bpvox's work: a stream of triangles in, a stream of solid bricks out, tile by tile, out of core.
///
/// If the source tells its bounds beforehand, the scene is read once. Else it is read for its bounds, and a second time
/// if it did not fit in memory. Triangles set voxels in bricks that all threads share; those that are large or have no
/// room there are sorted by tile, and each tile is voxelized by a backend. What the outside cannot reach, or what the
/// winding number says is inside, is filled over all tiles; the bricks leave in slab order. Tile size, memory and
/// threads change no voxel.
namespace bp {

struct VoxelizeOptions {
  /// Voxel size in scene units, given the scene's bounds; make_frame rounds it up a little.
  std::function<double(const Bounds3d&)> voxel_size;
  bool voxel_by_bounds = false;  ///< it depends on nothing else: it may be asked for before the scene has been read
  std::int32_t cell_vox = 0;     ///< edge of cells that the frame is aligned to (lib/grid/cells.h); 0: none
  FillMode fill = FillMode::flood;
  std::optional<UpAxis> up;  ///< of the header; empty: what the scene tells, else y
  /// For tiles at work: at least one, at most one a thread.
  std::uint64_t tile_memory_bytes = std::uint64_t(512) << 20;
  std::int32_t tile_vox = 0;  ///< 0: by the size of the grid; else a multiple of 64, <= 512
  /// The memory is for what waits: triangles, as they are or compressed in the store, and bricks on the shelf. The
  /// store and the shelf have their own bounds, together at most half of it; triangles get what these leave, and when
  /// it is spent, tiles are voxelized or go to the store. What a thread has in hand, and the tiles at work, come on
  /// top. The results are the voxels of chunks of the scene (surface_chunks.h); winding numbers need all triangles, and
  /// use none.
  PassContext context;
};

struct VoxelizeCounts {
  SceneCounts scene;
  std::string input_hash;           ///< XXH3-128 of the triangles' coordinates in their order, hex
  double area = 0, extent = 0;      ///< of all triangles: areas, and sides of their boxes; scene units, for estimates
  std::optional<StrayPart> stray;   ///< a small part that makes the bounds large
  double signed_volume = 0;         ///< that the triangles go around, scene units; of a closed surface its volume
  double voxel_asked = 0;           ///< scene units; the frame's may be larger
  std::uint64_t tiles = 0;          ///< of the grid
  std::uint64_t tiles_touched = 0;  ///< that hold triangles
  std::uint64_t surface_voxels = 0, solid_voxels = 0, bricks = 0, full_bricks = 0;
  std::uint64_t open_columns = 0;  ///< winding: columns whose crossings do not cancel; the flood decided there
  bool read_twice = false;         ///< the scene did not fit in memory, or chunks were not what they were
  std::uint64_t chunks = 0, chunks_kept = 0;  ///< of the scene's triangles; found among the results
  std::uint64_t scratch_bytes = 0;            ///< triangles and crossings put aside, compressed
};

/// The voxel size that gives `voxels` along the longest side of the bounds, or up to 1/128 fewer: it has 8 significant
/// bits; a scene that is one point gets some size that its frame can hold.
[[nodiscard]] double voxel_size_of(const Bounds3d& bounds, std::int64_t voxels);

/// The header of the solid layer of a scene with these bounds: all that is known before a voxel is. Throws as
/// make_frame().
[[nodiscard]] StreamHeader solid_header(const Bounds3d& bounds, double voxel, UpAxis up,
                                        const VoxelizeOptions& options);

/// What begins the output: gets the header (without provenance) and the counts of the scene once the frame is known,
/// and returns where the bricks go.
using OpenSink = std::function<BrickSink&(const StreamHeader&, const VoxelizeCounts&)>;

/// Without backends the tiles are voxelized on the computing threads. The caller calls finish() on the sink. Header:
/// bricks is the bricks of voxel_bounds(), slab_axis its longest axis. Throws bad_input if there is no triangle,
/// bad_argument if the grid cannot be had (too many voxels or tiles, too far from the origin, beyond kWindingVoxels for
/// winding).
VoxelizeCounts voxelize_stream(TriangleSource& source, const OpenSink& open, Backends& backends,
                               const VoxelizeOptions& options);

}  // namespace bp
