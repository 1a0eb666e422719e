#pragma once
#include <cstdint>

/// Limits on the numbers of a grid, so that no later step overflows or underflows. docs/brick-stream.md, section 10, is
/// the rule, and header_fault() (lib/grid/header_fault.h) is the one place that checks it.
namespace bp {

/// The edge of a voxel, scene units. Distances are measured with sixth powers of lengths, from 1/64 voxel to 2^48
/// voxels. With these limits both powers are ordinary doubles.
constexpr double kLeastVoxel = 0x1p-100, kMostVoxel = 0x1p100;

/// Bricks lie in [-kBrickReach, kBrickReach), and a grid has at most so many a side. Then sizes fit 32 bits, and so do
/// coordinates with a halo of 8191 voxels.
constexpr std::int32_t kBrickReach = (1 << 25) - 128;

/// The voxels around the grid that have exact lattice points, too, because proxies reach a little beyond their voxels.
constexpr std::int64_t kExactMarginVox = 2048;

}  // namespace bp
