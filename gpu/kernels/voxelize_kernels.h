#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/device_buffer.h"
#include "lib/core/box.h"
#include "lib/voxel/fixed_triangle.h"

/// Conservative surface voxelization on the device. The voxels are those of lib/voxel/voxelize.h, to the bit. There are
/// three routes, so that ten million triangles of one voxel and one triangle across the grid both keep all threads at
/// work: a thread for a triangle of up to 64 voxels, a warp for a larger one, the whole grid for the largest.
namespace bp {

class DeviceVoxelizer {
 public:
  explicit DeviceVoxelizer(int multiprocessors) : multiprocessors_(multiprocessors) {}

  /// Sets the voxels that the triangles meet, grown by `slack`. `triangles` and `bits` are on the device; `bits` is
  /// laid out as the BitBox of `box` (whole words of 64 voxels). No synchronisation; scratch grows with `count`.
  void enqueue(const FixedTriangle* triangles, std::uint32_t count, std::int64_t slack, const VoxelBox& box,
               std::uint32_t* bits, cudaStream_t stream);
  void release();

 private:
  int multiprocessors_;
  DeviceBuffer<std::uint32_t> lists_, counts_;
};

}  // namespace bp
