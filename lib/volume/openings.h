#pragma once
#include <functional>
#include <vector>

#include "lib/grid/bit_box.h"

/// How wide the empty space around voxels is, and how thick they are, by cubes: exact, on bits. A cube of reach r
/// around a voxel holds all within Chebyshev distance r. It is free if none of its voxels is solid. A place is as wide
/// as the largest free cube that holds it, wherever its middle is. So flat walls of any direction are wide, and so are
/// the corners where walls along the axes meet.
///
/// Every function needs context around the voxels that it is asked about: all else outside its box is empty.
namespace bp {

/// The solid voxels that lie more than 3 h voxels (Chebyshev) from the middle of each solid cube of reach h: parts at
/// most 2 h voxels thick, without their ends at thicker ones. h from 1 up. Exact 4 h voxels within the box.
[[nodiscard]] BitBox thin_parts(const BitBox& solid, std::int32_t h);

/// The empty voxels that no free cube of reach `r` holds. Exact 2 r voxels within the box.
[[nodiscard]] BitBox narrow_places(const BitBox& solid, std::int32_t r);

/// Middles of openings, by their width. `reaches` fall: r0 > r1 > ... Of level k, from 1 up, a place is in a free cube
/// of reach rk and in none of reach r(k-1). The middles of the level are those of free cubes of reach rk that hold such
/// a place, if a voxel of `near` lies within r(k-1) + 1 of the middle; null: all of them.
///
/// found(k, middles) is called for each k that has some within `tile`. `middles` has them, and more around. Exact if
/// the boxes hold tile.grown(3 r0 + 1). Cost: three dilations per level, of boxes that shrink with the reach.
void middles_of_openings(const BitBox& solid, const BitBox* near, const std::vector<std::int32_t>& reaches,
                         const VoxelBox& tile, const std::function<void(std::size_t, const BitBox&)>& found);

}  // namespace bp
