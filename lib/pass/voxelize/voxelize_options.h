#pragma once
#include <functional>
#include <optional>
#include <string>

#include "lib/core/triangle_source.h"
#include "lib/grid/stream.h"
#include "lib/pass/context.h"
#include "lib/pass/voxelize/stray_part.h"

namespace bp {

/// The options of the pass that voxelizes a scene (voxelize_pass.h).
struct VoxelizeOptions {
  /// Returns the voxel size in scene units, given the scene's bounds; make_frame rounds it up a little. It becomes
  /// kVoxelsPerOff times what points may be off by, if that is more.
  std::function<double(const Bounds3d&)> voxel_size;
  /// Voxel_size depends on the bounds only: it may be called before the scene has been read.
  bool voxel_by_bounds = false;
  std::int32_t cell_vox = 0;  ///< edge of cells that the frame is aligned to (lib/grid/cells.h); 0: none
  FillMode fill = FillMode::flood;
  std::optional<UpAxis> up;  ///< the header's; empty: what the scene tells, else y
  /// Memory for tiles at work: at least one tile, at most one a thread.
  std::uint64_t tile_memory_bytes = std::uint64_t(512) << 20;
  std::int32_t tile_vox = 0;  ///< 0: by the size of the grid; else a multiple of 64, <= 512
  /// The memory is for data that waits: triangles, as they are or compressed in the store, and bricks on the shelf. The
  /// store and the shelf have their own bounds, together at most half of it; triangles get the rest, and when it is
  /// spent, tiles are voxelized or go to the store. Data that threads have in hand and tiles at work come on top. The
  /// result store keeps the voxels of chunks of the scene (surface_chunks.h); winding numbers need all triangles, and
  /// use no chunks.
  PassContext context;
};

/// The counts of that pass.
struct VoxelizeCounts {
  SceneCounts scene;
  std::string input_hash;          ///< XXH3-128 of the triangles' coordinates in their order, hex
  double area = 0, extent = 0;     ///< of all triangles: areas, and sides of their boxes; scene units, for estimates
  std::optional<StrayPart> stray;  ///< a small part that makes the bounds large
  /// Volume that the triangles go around, scene units; for a closed surface the volume inside.
  double signed_volume = 0;
  double voxel_asked = 0;           ///< scene units; the frame's may be larger
  std::uint64_t tiles = 0;          ///< tiles of the grid
  std::uint64_t tiles_touched = 0;  ///< tiles that hold triangles
  std::uint64_t surface_voxels = 0, solid_voxels = 0, bricks = 0, full_bricks = 0;
  std::uint64_t open_columns = 0;  ///< winding: columns whose crossings do not cancel, where the flood decided
  bool read_twice = false;         ///< the scene did not fit in memory, or kept chunks were of another frame
  std::uint64_t chunks = 0, chunks_kept = 0;  ///< chunks of the scene's triangles, and those found among the results
  std::uint64_t scratch_bytes = 0;            ///< triangles and crossings in the store, compressed
};

}  // namespace bp
