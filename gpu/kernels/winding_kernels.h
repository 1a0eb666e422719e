#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/device_buffer.h"
#include "lib/voxel/winding.h"

/// The fill by winding numbers on the device: the crossings and the voxels of lib/voxel/winding.h, to the bit.
namespace bp {

class DeviceWinding {
 public:
  explicit DeviceWinding(int multiprocessors) : multiprocessors_(multiprocessors) {}

  /// Writes the crossings of the triangles in the tile to `out`, in any order, at most `capacity` of them. `found`
  /// becomes the number of all. All pointers are on the device. No synchronisation.
  void find(const FixedTriangle* triangles, std::uint32_t count, const VoxelBox& tile, Crossing* out,
            std::uint32_t capacity, std::uint32_t* found, cudaStream_t stream);

  /// Sets `bits`, laid out as the BitBox of `tile` (whole words of 64 voxels), to the voxels whose winding number is
  /// not zero, except in the columns of `skip` (a slice of the tile; null: none). `numbers`, x + y * width, holds the
  /// columns' numbers below the tile on entry, and above it afterwards. All pointers are on the device. No
  /// synchronisation.
  void fill(const Crossing* crossings, std::uint32_t count, const VoxelBox& tile, const std::uint32_t* skip,
            std::int32_t* numbers, std::uint32_t* bits, cudaStream_t stream);

  void release();

 private:
  int multiprocessors_;
  DeviceBuffer<std::uint32_t> large_;    ///< for find(): triangles that get a block each, their number first
  DeviceBuffer<std::uint32_t> buckets_;  ///< for fill(): crossings per bucket, ends of the buckets, and the total
  DeviceBuffer<Crossing> sorted_;        ///< for fill(): the crossings by bucket
};

}  // namespace bp
