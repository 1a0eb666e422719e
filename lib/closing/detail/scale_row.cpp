#include "lib/closing/detail/scale_row.h"

#include <cmath>

namespace bp::detail {

namespace {

/// Index of sample `i` (in samples from the world's origin) along one axis, moved into the lattice.
std::size_t clamped(std::int32_t i, std::int32_t origin, std::int32_t size) {
  return std::size_t(std::clamp(i - origin, 0, size - 1));
}

}  // namespace

ScaleRange scale_range(const ScaleLattice& lattice, const VoxelBox& box) {
  if (lattice.constant() || box.empty()) return {lattice.min, lattice.max};
  std::size_t lo[3], hi[3];
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = clamped(floor_div(box.min[axis], kScaleStep), lattice.origin[axis], lattice.size[axis]);
    hi[axis] = clamped(floor_div(box.max[axis] - 1, kScaleStep) + 1, lattice.origin[axis], lattice.size[axis]);
  }
  ScaleRange range{lattice.max, lattice.min};
  for (std::size_t z = lo[2]; z <= hi[2]; ++z) {
    for (std::size_t y = lo[1]; y <= hi[1]; ++y) {
      const Scale* row = &lattice.samples[(z * std::size_t(lattice.size.y) + y) * std::size_t(lattice.size.x)];
      const auto [low, high] = std::minmax_element(row + lo[0], row + hi[0] + 1);
      range = {std::min(range.min, *low), std::max(range.max, *high)};
    }
  }
  return range;
}

std::int32_t ball_reach(std::int32_t bound) {
  if (bound <= 1) return 0;
  auto r = std::int32_t(std::sqrt(double(bound - 1)));
  while (std::int64_t(r) * r >= bound) --r;
  while (std::int64_t(r + 1) * (r + 1) < bound) ++r;
  return r;
}

void ScaleRow::set(const ScaleLattice& lattice, std::int32_t y, std::int32_t z, std::int32_t x0, std::int32_t x1) {
  first_cell_ = floor_div(x0, kScaleStep);
  const std::int32_t count = floor_div(x1 - 1, kScaleStep) + 2 - first_cell_;
  sums_.resize(std::size_t(count));
  const std::int32_t cy = floor_div(y, kScaleStep), cz = floor_div(z, kScaleStep);
  const auto fy = std::uint32_t(y - cy * kScaleStep), fz = std::uint32_t(z - cz * kScaleStep);
  const auto row = [&](std::int32_t sy, std::int32_t sz) {
    return &lattice.samples[(clamped(sz, lattice.origin.z, lattice.size.z) * std::size_t(lattice.size.y) +
                             clamped(sy, lattice.origin.y, lattice.size.y)) *
                            std::size_t(lattice.size.x)];
  };
  const Scale *s00 = row(cy, cz), *s10 = row(cy + 1, cz), *s01 = row(cy, cz + 1), *s11 = row(cy + 1, cz + 1);
  const std::uint32_t w00 = (kScaleStep - fy) * (kScaleStep - fz), w10 = fy * (kScaleStep - fz),
                      w01 = (kScaleStep - fy) * fz, w11 = fy * fz;
  min_ = ~std::uint32_t(0);
  max_ = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::size_t x = clamped(first_cell_ + i, lattice.origin.x, lattice.size.x);
    const std::uint32_t sum = s00[x] * w00 + s10[x] * w10 + s01[x] * w01 + s11[x] * w11;
    sums_[std::size_t(i)] = sum;
    min_ = std::min(min_, sum);
    max_ = std::max(max_, sum);
  }
}

}  // namespace bp::detail
