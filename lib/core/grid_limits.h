#pragma once
#include <cstdint>

/// What the numbers of a grid must keep to, so that no later step over- or underflows. docs/brick-stream.md, section
/// 10, is the rule; header_fault() (lib/grid/header_fault.h) is the one place that checks it.
namespace bp {

/// Edge of a voxel, scene units. Distances are measured with the sixth power of lengths of up to 2^48 voxels, and with
/// that of 1/64 voxel: both are ordinary doubles.
constexpr double kLeastVoxel = 0x1p-100, kMostVoxel = 0x1p100;

/// Bricks lie in [-kBrickReach, kBrickReach), and a grid has at most so many a side: halos of 8191 voxels, and sizes,
/// fit 32 bits.
constexpr std::int32_t kBrickReach = (1 << 25) - 128;

/// Voxels around the grid whose lattice points are exact doubles, too: proxies reach a little beyond their voxels.
constexpr std::int64_t kExactMarginVox = 2048;

}  // namespace bp
