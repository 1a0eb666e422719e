#include "lib/volume/detail/clearance.h"

#include <algorithm>
#include <cstdlib>

#include "lib/core/parallel.h"

namespace bp {

namespace {

/// A voxel of a line whose values hold from `begin` on, until the next one's.
struct Span {
  std::int32_t voxel, begin;
};

/// Returns the last position at which voxel i of the line is as near as voxel u, which comes later: max(|x - i|, d(i))
/// is at most max(|x - u|, d(u)).
std::int32_t last_nearer(const std::vector<std::int32_t>& d, std::int32_t i, std::int32_t u) {
  const std::int32_t of_i = d[std::size_t(i)], of_u = d[std::size_t(u)], middle = (i + u) / 2;
  return of_i <= of_u ? std::max(i + of_u, middle) : std::min(u - of_i, middle);
}

/// Sets out(x) to the least max(|x - i|, line(i)) over all i, in linear time ([MRH00]). `spans` is scratch.
void spread(const std::vector<std::int32_t>& line, std::vector<std::int32_t>& out, std::vector<Span>& spans) {
  const auto n = std::int32_t(line.size());
  const auto at = [&](std::int32_t x, std::int32_t i) { return std::max(std::abs(x - i), line[std::size_t(i)]); };
  spans.assign(1, {0, 0});
  for (std::int32_t u = 1; u < n; ++u) {
    while (!spans.empty() && at(spans.back().begin, spans.back().voxel) > at(spans.back().begin, u)) spans.pop_back();
    const std::int32_t begin = spans.empty() ? 0 : 1 + last_nearer(line, spans.back().voxel, u);
    if (begin < n) spans.push_back({u, begin});
  }
  for (std::int32_t x = n - 1; x >= 0; --x) {
    out[std::size_t(x)] = at(x, spans.back().voxel);
    if (x == spans.back().begin) spans.pop_back();
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
    std::vector<Span> spans;
    VoxelCoord first = box_.min;
    first[third] += std::int32_t(slice);
    VoxelCoord next = first;
    if (length > 1) next[axis] += 1;
    const std::size_t step = index_of(next) - index_of(first);
    for (; first[second] < box_.max[second]; ++first[second]) {
      std::uint16_t* const d = distance_.data() + index_of(first);
      for (std::size_t i = 0; i < length; ++i) line[i] = d[i * step];
      axis == 0 ? spread_solid(line, out) : spread(line, out, spans);
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
