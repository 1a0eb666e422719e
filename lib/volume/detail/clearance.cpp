#include "lib/volume/detail/clearance.h"

#include <algorithm>
#include <cstdlib>

#include "lib/core/parallel.h"

namespace bp {

namespace {

/// Sets out(i) to the least max(|i - k|, line(k)) over all k. Cost: the sum of the results.
void spread(const std::vector<std::int32_t>& line, std::vector<std::int32_t>& out) {
  const auto n = std::int32_t(line.size());
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t least = i > 0 ? out[std::size_t(i - 1)] - 1 : 0;  // neighbours differ by at most 1
    std::int32_t best = line[std::size_t(i)];
    for (std::int32_t k = 1; k < best && best > least && (k <= i || i + k < n); ++k) {
      if (k <= i) best = std::min(best, std::max(k, line[std::size_t(i - k)]));
      if (i + k < n) best = std::min(best, std::max(k, line[std::size_t(i + k)]));
    }
    out[std::size_t(i)] = best;
  }
}

/// Does the same for a line of zeros and kMost, in one pass each way.
void spread_solid(const std::vector<std::int32_t>& line, std::vector<std::int32_t>& out) {
  const std::size_t n = line.size();
  for (std::size_t i = 0; i < n; ++i) out[i] = i > 0 ? std::min({line[i], out[i - 1] + 1, Clearance::kMost}) : line[i];
  for (std::size_t i = n - 1; i > 0; --i) out[i - 1] = std::min(out[i - 1], out[i] + 1);
}

}  // namespace

Clearance::Clearance(BitBox solid, const VoxelBox& box) : solid_(std::move(solid)), box_(box) {
  distance_.resize(std::size_t(box.volume()));
  const VoxelCoord size = box.size();
  parallel_for(size.z, [&](std::int64_t layer) {
    VoxelCoord p{0, 0, box_.min.z + std::int32_t(layer)};
    for (p.y = box_.min.y; p.y < box_.max.y; ++p.y) {
      p.x = box_.min.x;
      std::uint16_t* const row = distance_.data() + index_of(p);
      for (std::int32_t x = 0; x < size.x; ++x, ++p.x) row[x] = solid_.test(p) ? 0 : std::uint16_t(kMost);
    }
  });
  for (int axis = 0; axis < 3; ++axis) measure_along(axis);
  for (const std::uint16_t d : distance_) {
    if (d >= counts_.size()) counts_.resize(std::size_t(d) + 1);
    ++counts_[d];
  }
}

void Clearance::measure_along(int axis) {
  const int second = axis == 0 ? 1 : 0, third = axis == 2 ? 1 : 2;
  const auto length = std::size_t(box_.size()[axis]);
  parallel_for(box_.size()[third], [&](std::int64_t slice) {
    std::vector<std::int32_t> line(length), out(length);
    VoxelCoord first = box_.min;
    first[third] += std::int32_t(slice);
    VoxelCoord next = first;
    if (length > 1) next[axis] += 1;
    const std::size_t step = index_of(next) - index_of(first);
    for (; first[second] < box_.max[second]; ++first[second]) {
      std::uint16_t* const d = distance_.data() + index_of(first);
      for (std::size_t i = 0; i < length; ++i) line[i] = d[i * step];
      axis == 0 ? spread_solid(line, out) : spread(line, out);
      for (std::size_t i = 0; i < length; ++i) d[i * step] = std::uint16_t(out[i]);
    }
  });
}

std::int64_t Clearance::squared_distance(VoxelCoord p) const {
  const std::int32_t nearest = (*this)[index_of(p)];
  std::int64_t best = 3 * std::int64_t(nearest) * nearest;
  for (std::int32_t r = nearest; std::int64_t(r) * r < best || r == nearest; ++r) {
    const auto see = [&](std::int32_t dx, std::int32_t dy, std::int32_t dz) {
      const std::int64_t squared = std::int64_t(dx) * dx + std::int64_t(dy) * dy + std::int64_t(dz) * dz;
      if (squared < best && solid_.test({p.x + dx, p.y + dy, p.z + dz})) best = squared;
    };
    for (const std::int32_t way : {-r, r}) {  // most openings lie along the axes
      see(way, 0, 0);
      see(0, way, 0);
      see(0, 0, way);
    }
    for (std::int32_t a = -r; a <= r && std::int64_t(r) * r < best; ++a) {
      for (std::int32_t b = -r; b <= r; ++b) {
        for (const std::int32_t way : {-r, r}) {
          see(way, a, b);
          see(a, way, b);
          see(a, b, way);
        }
      }
    }
  }
  return best;
}

std::int32_t Clearance::least_run(VoxelCoord p) const {
  std::int32_t least = kMost;
  for (int axis = 0; axis < 3; ++axis) {
    VoxelCoord low = p, high = p;
    while (box_.contains(low) && !solid_.test(low)) --low[axis];
    while (box_.contains(high) && !solid_.test(high)) ++high[axis];
    if (box_.contains(low) && box_.contains(high)) least = std::min(least, high[axis] - low[axis] - 1);
  }
  return least;
}

}  // namespace bp
