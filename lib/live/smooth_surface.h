#pragma once
#include <array>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/core/packed_normal.h"
#include "lib/grid/bit_box.h"

namespace bp {

/// A surface to look at, as triangles with the normals of their corners.
struct SmoothSurface {
  std::vector<TriangleD> triangles;  ///< scene units, counter-clockwise seen from outside
  std::vector<std::array<PackedNormal, 3>> normals;
};

/// Returns the surface of occupied cells, with the corners of piece_of(). Its normals are piecewise smooth: creases of
/// a building stay. A cell is a cube of `cell_voxels` voxels of the frame. Parallel. Each face of a cell becomes two
/// triangles. Memory: about 200 bytes a triangle.
[[nodiscard]] SmoothSurface smooth_surface(const BitBox& cells, std::int32_t cell_voxels, const GridFrame& frame);

}  // namespace bp
