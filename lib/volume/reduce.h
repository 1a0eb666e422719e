#pragma once
#include "lib/grid/stream.h"

/// Conservative reduction by two: a coarse voxel is occupied if any of the eight fine voxels in it is. So the coarse
/// solid encloses the fine one, and whatever the fine one encloses. A level of detail made from it costs an eighth of
/// the finer one. The result depends on voxels only, neither on bricks nor on threads.
namespace bp {

/// Returns a frame with voxels twice as large. Its origin is a whole number of them from the scene's own
/// (docs/decisions/0001-exact-frame.md), at or one fine voxel below the fine origin. Exact: one more power of two in
/// the size, one bit less in the integers. Fine voxel p lies in coarse voxel floor((p + shift) / 2), where shift =
/// origin - 2 * coarse origin is 0 or 1.
[[nodiscard]] GridFrame reduced(const GridFrame& fine);

/// Returns the header of the reduced solid: new frame, bricks and slab axis, no closing. Bounds, fill and provenance
/// stay.
[[nodiscard]] StreamHeader reduced(const StreamHeader& fine);

/// Puts the bricks of the reduction of `fine`, whose frame is `frame`, onto `coarse`. Parallel. Cost: each fine brick
/// is fetched once, or up to eight times if the origin is odd; 400 KiB for each thread.
void reduce(const BrickShelf& fine, const GridFrame& frame, BrickShelf& coarse);

}  // namespace bp
