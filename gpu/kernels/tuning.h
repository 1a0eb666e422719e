#pragma once
#include <cstddef>
#include <cstdint>

/// Sizes of units of work and launch numbers of the GPU backend, in one place.
namespace bp {

constexpr int kCell = 8;           ///< voxels along one side of the cells in which whole answers are sought first
constexpr int kUnit = 16;          ///< outputs that one thread of the y and z passes holds in registers
constexpr int kRowGroup = 8;       ///< inputs that the y and z passes take or skip at a time
constexpr int kPassThreads = 256;  ///< threads of a block in all passes
/// Seeds around a word of a row beyond which the row pass looks around each voxel rather than at each seed (varying
/// scale).
constexpr int kFewSeeds = 12;

/// Memory for the distances of a slab of a tile; wider domains go in several slabs.
constexpr std::size_t kSlabBytes = std::size_t(3) << 29;
constexpr std::size_t kSlabShare = 32;  ///< of all device memory, at most: several backends share a device
/// Bits voxelized at a time; taller boxes go in several parts.
constexpr std::size_t kVoxelizeBytes = std::size_t(512) << 20;
/// Triangles on the device at a time.
constexpr std::size_t kTriangleBatch = std::size_t(1) << 18;
/// Crossings for which there is room at first; a batch of triangles that has more is gone through twice.
constexpr std::uint32_t kCrossingBatch = 1u << 20;
/// Crossings on the device at a time (256 MiB); a batch of triangles that has more is halved, a tile that has more is
/// filled on the host.
constexpr std::uint32_t kMostCrossings = 1u << 26;
/// Kernels count crossings in 32 bits.
constexpr std::uint64_t kCountedCrossings = 0xffffffffu;
/// Page-locked block for copies; two per backend.
constexpr std::size_t kStagingBytes = std::size_t(4) << 20;

}  // namespace bp
