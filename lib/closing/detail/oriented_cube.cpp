#include "lib/closing/detail/oriented_cube.h"

#include <algorithm>
#include <cstdlib>

namespace bp::detail {

namespace {

/// The x with |a x + c| <= limit, cut to [first, last].
void cut(std::int64_t a, std::int64_t c, std::int64_t limit, std::int64_t& first, std::int64_t& last) {
  if (a < 0) a = -a, c = -c;
  if (a == 0) {
    if (c > limit || c < -limit) last = first - 1;
    return;
  }
  first = std::max(first, ceil_div(-limit - c, a));
  last = std::min(last, floor_div(limit - c, a));
}

}  // namespace

bool keeps_axis(const Rotation& r, int axis) {
  int across = 0;
  for (const auto& row : r.row) {
    const bool along = row[axis] != 0;
    if (along && std::abs(row[axis]) != 1 << kRotationBits) return false;
    for (int k = 0; along && k < 3; ++k) {
      if (k != axis && row[k] != 0) return false;
    }
    across += along ? 0 : 1;
  }
  return across == 2;
}

CubeRows::CubeRows(const Rotation& r, Scale s, int flat) : reach_(cube_bounds(canonical(r)).reach(s)) {
  const std::int64_t limit = std::int64_t(s) * ((1 << kRotationBits) / kScaleOne);
  for (std::int32_t dz = -reach_; dz <= reach_; ++dz) {
    slices_.push_back(std::uint32_t(rows_.size()));
    for (std::int32_t dy = -reach_; dy <= reach_; ++dy) {
      if ((flat == 1 && dy != 0) || (flat == 2 && dz != 0)) continue;
      std::int64_t first = -reach_, last = reach_;
      for (const auto& row : r.row)
        cut(row[0], std::int64_t(row[1]) * dy + std::int64_t(row[2]) * dz, limit, first, last);
      if (first > last) continue;
      rows_.push_back({dy, std::int32_t(first), std::int32_t(last)});
      longest_ = std::max(longest_, std::int32_t(last - first) + 1);
    }
  }
  slices_.push_back(std::uint32_t(rows_.size()));
  rows_.shrink_to_fit();
}

}  // namespace bp::detail
