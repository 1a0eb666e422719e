#include "lib/check/distance.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"

namespace bp {

namespace {

std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

}  // namespace

void TriangleSample::see(std::uint64_t number, const TriangleD& t) {
  const std::uint64_t hash = mix(number + 1);
  if (capacity_ == 0 || (hash & mask_) != 0) return;
  kept_.push_back({hash, t});
  while (kept_.size() > capacity_) {
    mask_ = 2 * mask_ + 1;
    std::erase_if(kept_, [&](const Kept& k) { return (k.hash & mask_) != 0; });
  }
}

std::vector<Vec3d> TriangleSample::points() const {
  std::vector<Vec3d> points;
  for (const Kept& k : kept_) {
    Vec3d centroid{};
    for (const Vec3d& p : k.triangle) {
      points.push_back(p);
      for (std::size_t i = 0; i < 3; ++i) centroid[i] += p[i] / 3;
    }
    points.push_back(centroid);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

SampledDistance distances(const std::vector<Vec3d>& points, const TriangleBvh& to) {
  std::vector<double> d(points.size());
  parallel_chunks(std::int64_t(points.size()), 1024, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
      d[i] = std::sqrt(to.nearest(points[i]).distance_squared);
  });
  SampledDistance result;
  result.samples = points.size();
  for (std::size_t i = 0; i < d.size(); ++i) {
    result.mean += d[i];
    if (i == 0 || d[i] > result.max) result.max = d[i], result.where = points[i];
  }
  if (!points.empty()) result.mean /= double(points.size());
  return result;
}

}  // namespace bp
