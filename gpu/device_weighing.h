#pragma once
#include <span>
#include <vector>

#include "gpu/device_work.h"
#include "gpu/kernels/coordinate_kernels.h"
#include "lib/deform/weight_block.h"

namespace bp {

/// Backend::weigh() on a GPU. The calling thread weighs the points that the kernel leaves.
class DeviceWeighing {
 public:
  /// Weighs points. If they do not fit in device memory, it makes room and takes them in parts.
  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
             const DeviceWork& work, WeightBlock& out, std::span<CoordinateRows::Place> places);
  void release() { weigher_.release(); }

 private:
  /// Weighs some points. `first`: number of the first point in `out`.
  void weigh_part(const CageCoordinates& coordinates, std::span<const Vec3d> points, std::size_t first,
                  const DeviceWork& work, WeightBlock& out, std::span<CoordinateRows::Place> places);

  DeviceWeigher weigher_;
  std::vector<std::uint32_t> left_;  ///< points that are left to the calling thread
  CoordinateRows rows_;
};

}  // namespace bp
