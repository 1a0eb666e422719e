#pragma once
#include <random>

#include "lib/core/box.h"
#include "lib/voxel/fixed_triangle.h"

/// Triangles that take every route through the backends.
namespace bp::test {

using Rng = std::mt19937_64;

std::int64_t pick(Rng& rng, std::int64_t low, std::int64_t high);

/// A triangle around `box` that reaches about `extent` units; now and then flat, aligned, on voxel borders or
/// degenerate.
FixedTriangle random_triangle(Rng& rng, const VoxelBox& box, std::int64_t extent);

}  // namespace bp::test
