#pragma once
#include <span>
#include <vector>

#include "gpu/device_work.h"
#include "gpu/kernels/voxelize_kernels.h"
#include "gpu/kernels/winding_kernels.h"
#include "lib/grid/bit_box.h"

namespace bp {

/// The solid voxels of a tile on a GPU: Backend::voxelize(), find_crossings() and fill_winding(). Work that does not
/// fit in device memory is done in parts.
class DeviceSolid {
 public:
  DeviceSolid(DeviceWork work, int multiprocessors)
      : work_(std::move(work)), voxelizer_(multiprocessors), winding_(multiprocessors) {}

  void voxelize(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack);
  void find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out);
  void fill_winding(std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                    std::span<std::int32_t> numbers, BitBox& bits);
  /// Frees all device memory.
  void release();

 private:
  void voxelize_part(std::span<const FixedTriangle> triangles, std::int64_t slack, const VoxelBox& part,
                     std::size_t words, std::uint64_t* bits);
  void find_in_batch(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out);
  bool find_at_once(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out);
  void fill_on_device(const std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                      std::span<std::int32_t> numbers, BitBox& bits);

  DeviceWork work_;
  DeviceVoxelizer voxelizer_;
  DeviceWinding winding_;
  DeviceBuffer<FixedTriangle> triangles_;
  DeviceBuffer<Crossing> crossings_;
  DeviceBuffer<std::int32_t> numbers_;
  DeviceBuffer<std::uint32_t> bits_, skip_, count_;
};

}  // namespace bp
