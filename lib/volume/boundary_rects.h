#pragma once
#include <array>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"

namespace bp {

/// Faces between occupied and empty voxels of one brick that make a rectangle.
struct FaceRect {
  VoxelCoord min, max;  ///< its corners, in voxels; equal along one axis
  friend bool operator==(const FaceRect&, const FaceRect&) = default;
};

/// Returns the rectangle in scene units.
[[nodiscard]] std::array<TriangleD, 2> triangles_of(const FaceRect& rect, const GridFrame& frame);

/// Returns all faces of the voxels, each in one rectangle. As a set of points they are the surface of `solid`. A
/// rectangle begins with a run of faces and takes in equal runs next to it. The order is by brick, as on the shelf.
/// Parallel; the result depends on the voxels alone. Cost: linear in the bricks, 24 bytes a rectangle, twice for a
/// moment.
[[nodiscard]] std::vector<FaceRect> boundary_rects(const BrickShelf& solid);

}  // namespace bp
