#pragma once
#include <functional>
#include <vector>

#include "lib/grid/bit_box.h"

/// Measures how wide the empty space around voxels is, and how thick they are, by cubes: exact, on bits. A cube of
/// reach r around a voxel holds everything within Chebyshev distance r. It is free if none of its voxels is solid. A
/// place is as wide as the largest free cube that holds it, wherever its middle is. So flat walls of any direction are
/// wide, and so are the corners where walls along the axes meet.
///
/// Every function needs context around the voxels in question: everything outside its box counts as empty.
namespace bp {

/// Returns the solid voxels that lie more than 3 h voxels (Chebyshev) from the middle of each solid cube of reach h:
/// parts at most 2 h voxels thick, without their ends at thicker parts. h from 1 up. Exact 4 h voxels within the box.
[[nodiscard]] BitBox thin_parts(const BitBox& solid, std::int32_t h);

/// Returns the empty voxels that no free cube of reach `r` holds. Exact 2 r voxels within the box.
[[nodiscard]] BitBox narrow_places(const BitBox& solid, std::int32_t r);

/// Finds openings by their width. `reaches` fall: r0 > r1 > ... A place of level k, from 1 up, is in a free cube of
/// reach rk and in none of reach r(k-1). The result of a level is its places, and the middles of free cubes of reach rk
/// that hold one of them. With `near`, it is only the middles within r(k-1) + 1 of a voxel of `near`, and the places
/// that they hold.
///
/// found(k, voxels) is called for each k that has some within `tile`. `voxels` has these, and more around. Exact if the
/// boxes hold tile.grown(4 r0 + 1). Cost: four dilations per level, of boxes that shrink with the reach.
void openings(const BitBox& solid, const BitBox* near, const std::vector<std::int32_t>& reaches, const VoxelBox& tile,
              const std::function<void(std::size_t, const BitBox&)>& found);

}  // namespace bp
