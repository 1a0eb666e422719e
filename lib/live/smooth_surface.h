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

/// Returns the surface of occupied cells, which is smooth as that of piece_of(). A cell is a cube of `cell_voxels`
/// voxels of the frame. Parallel. Each face of a cell becomes two triangles.
[[nodiscard]] SmoothSurface smooth_surface(const BitBox& cells, std::int32_t cell_voxels, const GridFrame& frame);

}  // namespace bp
