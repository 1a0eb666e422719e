#pragma once
#include <cstddef>
#include <cstdint>

/// Sizes of units of work and launch numbers of the GPU backend, in one place.
namespace bp {

constexpr int kCell = 8;           ///< voxels along one side of the cells that are answered as a whole first
constexpr int kUnit = 16;          ///< outputs that one thread of the y and z passes holds in registers
constexpr int kRowGroup = 8;       ///< inputs that the y and z passes take or skip at a time
constexpr int kPassThreads = 256;  ///< threads of a block in all passes
/// If a word of a row has more seeds around it, the row pass looks around each voxel rather than at each seed (varying
/// scale).
constexpr int kFewSeeds = 12;

/// Memory for the distances of a slab of a tile. Wider domains take several slabs.
constexpr std::size_t kSlabBytes = std::size_t(3) << 29;
constexpr std::size_t kSlabShare = 32;  ///< a 32nd of all device memory at most, since several backends share a device
/// Bits that are voxelized at a time. Taller boxes take several parts.
constexpr std::size_t kVoxelizeBytes = std::size_t(512) << 20;
/// Triangles on the device at a time.
constexpr std::size_t kTriangleBatch = std::size_t(1) << 18;
/// Room for crossings at first. A batch of triangles with more crossings is gone through twice.
constexpr std::uint32_t kCrossingBatch = 1u << 20;
/// Crossings on the device at a time (256 MiB). A batch of triangles with more is halved; a tile with more is filled on
/// the host.
constexpr std::uint32_t kMostCrossings = 1u << 26;
/// Kernels count crossings in 32 bits.
constexpr std::uint64_t kCountedCrossings = 0xffffffffu;
/// Size of a page-locked block for copies. A backend has two.
constexpr std::size_t kStagingBytes = std::size_t(4) << 20;

}  // namespace bp
