#include "lib/device/cpu/fallback_backend.h"

#include <algorithm>

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

void FallbackBackend::voxelize(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack) {
  BitBox before;
  if (device_) before = out;
  if (device_does([&](Backend& device) { device.voxelize(triangles, out, slack); })) return;
  if (!before.box().empty()) out = std::move(before);
  cpu_.voxelize(triangles, out, slack);
}

void FallbackBackend::find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                                     std::vector<Crossing>& out) {
  const std::size_t before = out.size();
  if (device_does([&](Backend& device) { device.find_crossings(triangles, tile, out); })) return;
  out.resize(before);
  cpu_.find_crossings(triangles, tile, out);
}

void FallbackBackend::fill_winding(std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                                   std::span<std::int32_t> numbers, BitBox& bits) {
  if (!device_) return cpu_.fill_winding(crossings, skip, numbers, bits);
  std::vector<Crossing> crossings_before = crossings;
  const std::vector<std::int32_t> numbers_before(numbers.begin(), numbers.end());
  BitBox bits_before = bits;
  if (device_does([&](Backend& device) { device.fill_winding(crossings, skip, numbers, bits); })) return;
  crossings = std::move(crossings_before);
  std::copy(numbers_before.begin(), numbers_before.end(), numbers.begin());
  bits = std::move(bits_before);
  cpu_.fill_winding(crossings, skip, numbers, bits);
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
