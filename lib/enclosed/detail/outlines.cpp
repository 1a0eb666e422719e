#include "lib/enclosed/detail/outlines.h"

#include <algorithm>
#include <limits>

namespace bp::detail {

Outlines::Outlines(VoxelCoord first, std::int32_t rows, std::int32_t layers)
    : first_(first), lines_(rows + 1), planes_(layers + 1) {
  using Limits = std::numeric_limits<std::int32_t>;
  ends_.assign(std::size_t(lines_) * std::size_t(planes_), {Limits::max(), Limits::min()});
}

void Outlines::add(std::int32_t low, std::int32_t high, std::int32_t y, std::int32_t z) {
  for (int i = 0; i < 4; ++i) {
    const std::int32_t line = y - first_.y + i % 2, plane = z - first_.z + i / 2;
    Ends& ends = ends_[std::size_t(plane) * std::size_t(lines_) + std::size_t(line)];
    ends = {std::min(ends.low, low), std::max(ends.high, high)};
  }
}

void Outlines::add_corners_to(std::vector<LatticeBox>& out) const {
  for (std::int32_t plane = 0; plane < planes_; ++plane) {
    for (const bool low : {true, false}) {
      for (const LatticeCoord& p : side(plane, low)) out.push_back({p * kLatticePerVoxel, p * kLatticePerVoxel});
    }
  }
}

/// Returns the corners of the outline as seen from low or high x, by y; in voxels.
std::vector<LatticeCoord> Outlines::side(std::int32_t plane, bool low) const {
  std::vector<LatticeCoord> chain;
  for (std::int32_t line = 0; line < lines_; ++line) {
    const Ends& ends = ends_[std::size_t(plane) * std::size_t(lines_) + std::size_t(line)];
    if (ends.low > ends.high) continue;
    const LatticeCoord next = LatticeCoord{low ? ends.low : ends.high, first_.y + line, first_.z + plane};
    const auto is_inner = [&](const LatticeCoord& p, const LatticeCoord& q) {
      const std::int64_t turn = (q.x - p.x) * (next.y - p.y) - (next.x - p.x) * (q.y - p.y);
      return low ? turn >= 0 : turn <= 0;
    };
    while (chain.size() > 1 && is_inner(chain[chain.size() - 2], chain.back())) chain.pop_back();
    chain.push_back(next);
  }
  return chain;
}

}  // namespace bp::detail
