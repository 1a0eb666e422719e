#include "lib/check/detail/distance.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/geometry/surface_distance.h"

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
  struct Numbered {
    Vec3d point;
    std::size_t number;
  };
  std::vector<Numbered> all;
  const auto add = [&](const Vec3d& p) { all.push_back({p, all.size()}); };
  for (const Kept& k : kept_) {
    Vec3d centroid{};
    for (const Vec3d& p : k.triangle) {
      add(p);
      for (std::size_t i = 0; i < 3; ++i) centroid[i] += p[i] / 3;
    }
    add(centroid);
  }
  std::sort(all.begin(), all.end(), [](const Numbered& a, const Numbered& b) {
    return a.point != b.point ? a.point < b.point : a.number < b.number;
  });
  const auto same = [](const Numbered& a, const Numbered& b) { return a.point == b.point; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  std::sort(all.begin(), all.end(), [](const Numbered& a, const Numbered& b) { return a.number < b.number; });
  std::vector<Vec3d> points;
  for (const Numbered& n : all) points.push_back(n.point);
  return points;
}

SampledDistance distances(const std::vector<Vec3d>& points, const TriangleBvh& to) {
  std::vector<double> d(points.size());
  parallel_ranges(std::int64_t(points.size()), 1024, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;  // neighbours in the stream are mostly neighbours in space
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      const TriangleBvh::Nearest nearest = to.nearest(points[i], guess);
      d[i] = std::sqrt(nearest.distance_squared);
      guess = nearest.item;
    }
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

void bound_largest(const std::vector<TriangleD>& from, const TriangleBvh& to, SampledDistance& distance) {
  const SurfaceDistance all = largest_distance(from, to);
  if (!std::isfinite(all.at_most)) return;
  if (all.at_least > distance.max) distance.max = all.at_least, distance.where = all.where;
  distance.at_most = std::max(all.at_most, distance.max);
}

}  // namespace bp
