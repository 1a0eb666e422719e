#include "lib/device/cpu/fallback_backend.h"

namespace bp {

bool FallbackBackend::device_does(const std::function<void(Backend&)>& call) {
  if (!device_) return false;
  try {
    call(*device_);
    return true;
  } catch (const DeviceError& e) {
    device_.reset();
    warn_(e);
    return false;
  }
}

void FallbackBackend::close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo,
                            const ClosingParams& params, const VoxelBox& interior, BitBox& closed) {
  if (device_does([&](Backend& device) { device.close(solid, scale, halo, params, interior, closed); })) return;
  cpu_.close(solid, scale, halo, params, interior, closed);
}

void FallbackBackend::close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale,
                                       const Halo& halo, const ClosingParams& params, const VoxelBox& interior,
                                       BitBox& closed) {
  if (device_does(
          [&](Backend& device) { device.close_from_shelf(solid, bricks, scale, halo, params, interior, closed); })) {
    return;
  }
  cpu_.close_from_shelf(solid, bricks, scale, halo, params, interior, closed);
}

void FallbackBackend::weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                            WeightBlock& out, std::span<CoordinateRows::Place> places) {
  if (device_does([&](Backend& device) { device.weigh(coordinates, points, carry_outside, out, places); })) return;
  cpu_.weigh(coordinates, points, carry_outside, out, places);
}

}  // namespace bp
