#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/grid/bit_box.h"
#include "lib/voxel/crossing.h"
#include "lib/voxel/fixed_triangle.h"

/// Winding numbers of voxel centres along the columns of the grid (columns run along z), exact in integers.
///
/// A column stands at the centre of its voxels' bases, moved by an infinitely small (e, e^2) in (x, y): it never meets
/// an edge or a vertex, so that every column crosses a closed mesh as often upwards as downwards, and the crossings
/// cancel exactly. The number at a voxel is the signed count of crossings below its centre, or at it.
namespace bp {

/// Longest side of a scene, in voxels, for which crossings are exact.
constexpr std::int64_t kWindingVoxels = std::int64_t(1) << 24;

/// Appends the crossings of the tile's columns that lie in the tile: those where the voxel that holds the crossing
/// point (the upper one at a border) does. Each crossing of the scene lies in exactly one tile, one that the triangle
/// meets. Vertical and degenerate triangles have none. Triangles may be up to kWindingVoxels long.
void find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out);

/// Adds the crossings' signs to the numbers of the columns: `numbers` is x + y * tile.size().x.
void add_crossings(std::span<const Crossing> crossings, const VoxelBox& tile, std::span<std::int32_t> numbers);

/// Sets the voxels of `tile` whose number is not zero. `numbers`: of the columns below the tile on entry, above it on
/// return. Columns of `skip` (bits in the layout of a BitBox slice of the tile; empty: none) are left alone.
/// Crossings are reordered.
void fill_winding(std::vector<Crossing>& crossings, const VoxelBox& tile, std::span<const std::uint64_t> skip,
                  std::span<std::int32_t> numbers, BitBox& bits);

}  // namespace bp
