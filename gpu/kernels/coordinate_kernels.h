#pragma once
#include <cuda_runtime.h>

#include <span>

#include "gpu/kernels/device_buffer.h"
#include "gpu/staging.h"
#include "lib/deform/coordinates.h"
#include "lib/deform/formulas/cage_view.h"

/// Coordinates of cages on the device, rounded: the units of round_weights() in lib/deform/weight_block.h, to the bit.
namespace bp {

/// The cage and the scratch of the formulas on the device.
struct WeighTask {
  detail::CageView cage;
  CoordinateKind kind = CoordinateKind::mean_value;
  const Vec3d* points = nullptr;
  std::uint32_t count = 0;
  double* scratch = nullptr;  ///< of each warp: the numbers of its points side by side
  std::int32_t* units = nullptr;
  std::uint8_t* done = nullptr;
};

/// Weighs one point per thread. Points on the cage or outside of it, and points that need other bits than
/// WeightBlock::kBits, are left.
class DeviceWeigher {
 public:
  /// Copies the cage and the points, which are small compared with the weights.
  void upload(const CageCoordinates& coordinates, std::span<const Vec3d> points, Staging& staging);
  /// Enqueues the kernel, without synchronisation.
  void enqueue(cudaStream_t stream);
  [[nodiscard]] const std::int32_t* units() const { return units_.data(); }  ///< column by column; device memory
  [[nodiscard]] const std::uint8_t* done() const { return done_.data(); }    ///< by point; device memory
  void release();

 private:
  WeighTask task_;
  DeviceBuffer<Vec3d> points_, vertices_;
  DeviceBuffer<Cage::Edge> edges_;
  DeviceBuffer<Cage::Face> faces_;
  DeviceBuffer<detail::GreenFace> green_;
  DeviceBuffer<double> lengths_, scratch_;
  DeviceBuffer<std::int32_t> units_;
  DeviceBuffer<std::uint8_t> done_;
};

}  // namespace bp
