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
/// Size of a page-locked block for copies. A backend has two.
constexpr std::size_t kStagingBytes = std::size_t(4) << 20;

}  // namespace bp
