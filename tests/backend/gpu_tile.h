#pragma once
#include "gpu/device_closing.h"
#include "tests/backend/hierarchical_kernels.h"

/// A tile on the device, closed by the path of one's choice: for tests and benchmarks of gpu/ itself.
namespace bp {

class GpuTile {
 public:
  GpuTile(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const VoxelBox& interior);
  void close(DeviceClosing& closing, StructuringElement element, cudaStream_t stream,
             const DeviceClosing::Mark& mark = {});
  void close(HierarchicalClosing& closing, StructuringElement element, HierarchicalVariant variant, cudaStream_t stream,
             const DeviceClosing::Mark& mark = {});
  /// From now on both paths dilate by cubes of these orientations; `region` holds the dilation.
  void orient(const OrientationField& field, const VoxelBox& region);
  /// Orients the hierarchical path only.
  void orient(const RotationLattice& rotations);
  /// Overwrites the device's result with garbage, so that a stale one cannot pass for a new one.
  void poison(cudaStream_t stream);
  [[nodiscard]] BitBox result(cudaStream_t stream) const;
  [[nodiscard]] const TileLayout& layout() const { return layout_; }

 private:
  const ScaleLattice scale_;
  VoxelBox interior_;
  TileLayout layout_;
  DeviceBuffer<std::uint32_t> solid_, closed_;
  DeviceBuffer<Scale> samples_;
  DeviceBuffer<Rotation> rotation_cells_, cube_rotations_;
  RotationView rotations_;
  CubesOver cubes_;
  DeviceBuffer<std::uint16_t> cube_cells_;
  CubeView cubes_there_;
};

}  // namespace bp
