#include "lib/closing/detail/scale_row.h"

#include <cmath>

#include "lib/closing/detail/simd.h"

namespace bp::detail {

namespace {

/// Returns the place in the lattice of sample `i`, counted from the world's origin along one axis. It is clamped to the
/// lattice.
std::size_t clamped(std::int32_t i, std::int32_t origin, std::int32_t size) {
  return std::size_t(std::clamp(i - origin, 0, size - 1));
}

/// The four samples around a row (at y and y + 1, z and z + 1), and their weights, which add up to 64.
struct Corners {
  const Scale* sample[4];
  std::uint32_t weight[4];
};
BP_CLONES void combine(const Corners& c, std::size_t first, std::size_t count, std::uint32_t* sums) {
  const Scale *a = c.sample[0] + first, *b = c.sample[1] + first, *d = c.sample[2] + first, *e = c.sample[3] + first;
  for (std::size_t i = 0; i < count; ++i)
    sums[i] = a[i] * c.weight[0] + b[i] * c.weight[1] + d[i] * c.weight[2] + e[i] * c.weight[3];
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
  const Corners corners{
      {row(cy, cz), row(cy + 1, cz), row(cy, cz + 1), row(cy + 1, cz + 1)},
      {(kScaleStep - fy) * (kScaleStep - fz), fy * (kScaleStep - fz), (kScaleStep - fy) * fz, fy * fz}};
  const std::int32_t lo = std::clamp(lattice.origin.x - first_cell_, 0, count),
                     hi = std::clamp(lattice.origin.x + lattice.size.x - first_cell_, lo, count);
  std::uint32_t *begin = sums_.data(), *end = begin + count;
  if (lo < hi) combine(corners, std::size_t(first_cell_ + lo - lattice.origin.x), std::size_t(hi - lo), begin + lo);
  if (lo > 0) {  // beyond the lattice its outermost samples hold
    combine(corners, 0, 1, begin);
    std::fill(begin + 1, begin + lo, *begin);
  }
  if (hi < count) {
    combine(corners, std::size_t(lattice.size.x - 1), 1, begin + hi);
    std::fill(begin + hi + 1, end, begin[hi]);
  }
  min_ = max_ = *begin;
  for (const std::uint32_t* sum = begin; sum < end; ++sum) {
    min_ = std::min(min_, *sum);
    max_ = std::max(max_, *sum);
  }
}

}  // namespace bp::detail
