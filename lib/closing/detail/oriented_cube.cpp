#include "lib/closing/detail/oriented_cube.h"

#include <algorithm>
#include <cstdlib>

namespace bp::detail {

namespace {

/// The x with |a x + c| <= limit, cut to [first, last]. All are below 2^29: rows of 2^14 times a reach of 2^13, twice.
void cut(std::int32_t a, std::int32_t c, std::int32_t limit, std::int32_t& first, std::int32_t& last) {
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
  const std::int32_t limit = s * ((1 << kRotationBits) / kScaleOne);
  for (std::int32_t dz = -reach_; dz <= 0; ++dz) {
    slices_.push_back(std::uint32_t(rows_.size()));
    for (std::int32_t dy = -reach_; dy <= reach_; ++dy) {
      if ((flat == 1 && dy != 0) || (flat == 2 && dz != 0)) continue;
      std::int32_t first = -reach_, last = reach_;
      for (const auto& row : r.row) cut(row[0], row[1] * dy + row[2] * dz, limit, first, last);
      if (first > last) continue;
      rows_.push_back({dy, first, last});
      longest_ = std::max(longest_, last - first + 1);
    }
  }
  for (std::int32_t dz = 1; dz <= reach_; ++dz) {  // the cube is its own image through its centre
    slices_.push_back(std::uint32_t(rows_.size()));
    const std::size_t begin = slices_[std::size_t(reach_ - dz)], end = slices_[std::size_t(reach_ - dz) + 1];
    for (std::size_t i = end; i-- > begin;) rows_.push_back({-rows_[i].dy, -rows_[i].last, -rows_[i].first});
  }
  slices_.push_back(std::uint32_t(rows_.size()));
  rows_.shrink_to_fit();
}

}  // namespace bp::detail
