#pragma once
#include <functional>

#include "lib/pass/voxelize/voxelize_options.h"

/// The work of bpvox: a stream of triangles in, a stream of solid bricks out, tile by tile, out of core. If the source
/// tells its bounds beforehand, the scene is read once. Otherwise it is read for its bounds, and a second time if it
/// did not fit in memory. Triangles set voxels in bricks that all threads share; triangles that are large or have no
/// room there are sorted by tile, and each tile is voxelized by one thread. Voxels that the outside cannot reach, or
/// that the winding number says are inside, are filled over all tiles; the bricks leave in slab order. Tile size,
/// memory and threads change no voxel.
namespace bp {

/// Returns the voxel size that gives `voxels` along the longest side of the bounds, or up to 1/128 fewer, since it is
/// rounded to 8 significant bits. For a scene that is one point: some size that its frame can hold.
[[nodiscard]] double voxel_size_of(const Bounds3d& bounds, std::int64_t voxels);

/// Returns the header of the solid layer of a scene with these bounds: all that is known before a voxel is. Throws as
/// make_frame().
[[nodiscard]] StreamHeader solid_header(const Bounds3d& bounds, double voxel, UpAxis up,
                                        const VoxelizeOptions& options);

/// Begins the output once the frame is known: gets the header (without provenance) and the counts of the scene, and
/// returns where the bricks go.
using OpenSink = std::function<BrickSink&(const StreamHeader&, const VoxelizeCounts&)>;

/// Voxelizes a scene. The caller calls finish() on the sink.
/// The header's bricks are those of voxel_bounds(), its slab_axis is their longest axis. Throws bad_input if there is
/// no triangle, bad_argument if the grid is impossible (too many voxels or tiles, too far from the origin, beyond
/// kWindingVoxels for winding).
VoxelizeCounts voxelize_stream(TriangleSource& source, const OpenSink& open, const VoxelizeOptions& options);

}  // namespace bp
