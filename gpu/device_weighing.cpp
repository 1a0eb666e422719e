#include "gpu/device_weighing.h"

#include <algorithm>

#include "gpu/kernels/device_error.h"

namespace bp {

void DeviceWeighing::weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                           const DeviceWork& work, WeightBlock& out, std::span<CoordinateRows::Place> places) {
  left_.clear();
  for (std::size_t first = 0, step = points.size(); first < points.size();) {
    const std::size_t n = std::min(step, points.size() - first);
    try {
      weigh_part(coordinates, points.subspan(first, n), first, work, out, places);
      first += n;
    } catch (const OutOfDeviceMemory&) {
      if (n == 1) throw;
      work.make_room();
      step = n / 2;
    }
  }
  weigh_some(coordinates, points, left_, carry_outside, rows_, out, places);
}

void DeviceWeighing::weigh_part(const CageCoordinates& coordinates, std::span<const Vec3d> points, std::size_t first,
                                const DeviceWork& work, WeightBlock& out, std::span<CoordinateRows::Place> places) {
  const std::size_t n = points.size();
  weigher_.upload(coordinates, points, work.staging);
  weigher_.enqueue(work.stream);
  std::vector<std::uint8_t> done(n);
  work.staging.download(done.data(), weigher_.done(), n);
  const std::size_t bytes = n * out.columns * sizeof(std::int32_t);
  if (n == out.points) {
    work.staging.download(out.units.data(), weigher_.units(), bytes);
  } else {
    std::vector<std::int32_t> units(n * out.columns);
    work.staging.download(units.data(), weigher_.units(), bytes);
    for (std::size_t c = 0; c < out.columns; ++c)
      std::copy_n(units.data() + c * n, n, out.units.data() + c * out.points + first);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (done[i] == 0) left_.push_back(std::uint32_t(first + i));
    out.bits[first + i] = WeightBlock::kBits, places[first + i] = CoordinateRows::Place::inside;
  }
}

}  // namespace bp
