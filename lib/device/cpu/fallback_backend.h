#pragma once
#include <functional>

#include "lib/device/cpu/cpu_backend.h"
#include "lib/device/device_error.h"

namespace bp {

/// Uses a device's backend as long as the device works. The first call that ends in a DeviceError frees the device's
/// memory and is repeated on the CPU, with its original arguments, as are all later calls. Arguments that a call both
/// reads and writes are copied first, which costs little compared with the transfer.
class FallbackBackend final : public Backend {
 public:
  /// `warn` is called once, on the thread of the failed call, with its error.
  FallbackBackend(std::unique_ptr<Backend> device, std::function<void(const DeviceError&)> warn)
      : device_(std::move(device)), warn_(std::move(warn)), name_(device_->name()) {}

  [[nodiscard]] std::string name() const override { return device_ ? name_ : name_ + ", then cpu"; }
  [[nodiscard]] std::uint64_t pinned_bytes() const override { return device_ ? device_->pinned_bytes() : 0; }
  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override;
  void close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale, const Halo& halo,
                        const ClosingParams& params, const VoxelBox& interior, BitBox& closed) override;
  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override;

 private:
  /// Returns true if the device made the call.
  bool device_does(const std::function<void(Backend&)>& call);

  std::unique_ptr<Backend> device_;  ///< null once it has failed
  CpuBackend cpu_;
  std::function<void(const DeviceError&)> warn_;
  std::string name_;
};

}  // namespace bp
