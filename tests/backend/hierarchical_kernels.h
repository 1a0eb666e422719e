#pragma once
#include <cuda_runtime.h>

#include "gpu/device_closing.h"

/// The paper's own algorithm ([CB17] Alg. 1 and 2): every voxel walks a max-mipmap of the grid, and one of the contour
/// that carries the largest scale, until its element meets an occupied voxel. It is the baseline of the benchmark and a
/// second opinion on every bit. Tools use DeviceClosing.
///
/// The walk is tuned as far as it goes without becoming another algorithm: a byte for eight children, a stack of masks
/// in one register, the nearest child first, a start at the level whose nodes just exceed the element, warps over
/// compact blocks.
namespace bp {

enum class HierarchicalVariant {
  plain,           ///< Alg. 1 and 2 at every voxel
  half_resolution  ///< first on blocks of 2^3 voxels, which a cell wholly in reach settles; voxels only where that
                   ///< leaves open
};

class HierarchicalClosing {
 public:
  explicit HierarchicalClosing(int multiprocessors) : multiprocessors_(multiprocessors) {}

  /// Does what DeviceClosing::enqueue() does, with the same bits. With `rotations` the dilation is by cubes of these
  /// orientations, and `element` is ignored; the halo must then allow for oriented_reach().
  void enqueue(const TileLayout& layout, const std::uint32_t* solid, const ScaleLattice& scale, const Scale* samples,
               StructuringElement element, HierarchicalVariant variant, std::uint32_t* closed, cudaStream_t stream,
               const DeviceClosing::Mark& mark = {}, const RotationView* rotations = nullptr);

 private:
  int multiprocessors_;
  DeviceBuffer<std::uint32_t> solid_, dilated_, contour_, closed_, cells_, blocks_, count_;
  DeviceBuffer<std::uint8_t> nodes_;
  DeviceBuffer<Scale> scales_;
};

}  // namespace bp
