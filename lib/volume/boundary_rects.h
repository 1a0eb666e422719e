#pragma once
#include <array>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"

namespace bp {

/// Faces between occupied and empty voxels that make a rectangle, within one brick.
struct FaceRect {
  VoxelCoord min, max;  ///< its corners, in voxels; equal along one axis
  friend bool operator==(const FaceRect&, const FaceRect&) = default;
};

/// The rectangle, scene units.
[[nodiscard]] std::array<TriangleD, 2> triangles_of(const FaceRect& rect, const GridFrame& frame);

/// All faces of the voxels, each in one rectangle: as a set of points, the surface of `solid`. A rectangle begins with
/// a run of faces and takes the like runs beside it. By brick, in the shelf's order. Parallel; the result depends on
/// the voxels alone. Cost: linear in the bricks, 24 bytes a rectangle, twice for a moment.
[[nodiscard]] std::vector<FaceRect> boundary_rects(const BrickShelf& solid);

}  // namespace bp
