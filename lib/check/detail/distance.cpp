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

bool TriangleSample::may_keep(std::uint64_t number) const {
  return capacity_ > 0 && (mix(number + 1) & mask_.load(std::memory_order_relaxed)) == 0;
}

void TriangleSample::see(std::uint64_t number, const TriangleD& t) {
  const std::uint64_t hash = mix(number + 1);
  if (capacity_ == 0 || (hash & mask_) != 0) return;
  kept_.push_back({hash, t});
  while (kept_.size() > capacity_) {
    mask_ = 2 * mask_.load() + 1;
    std::erase_if(kept_, [&](const Kept& k) { return (k.hash & mask_) != 0; });
  }
}

SceneMemory::Part SceneMemory::part_of(const SceneBatch& batch) const {
  Part part;
  part.count = batch.count;
  const bool keeps = keeps_;
  if (keeps) part.all.reserve(batch.count);
  batch.for_each([&](std::uint64_t number, const TriangleD& t, std::uint8_t) {
    if (keeps) part.all.push_back(t);
    if (sample_.may_keep(number)) part.sampled.push_back({number, t});
  });
  return part;
}

void SceneMemory::add(Part&& part) {
  for (const Part::Numbered& t : part.sampled) sample_.see(t.number, t.triangle);
  count_ += part.count;
  if (keeps_ && count_ > most_) {
    keeps_ = false;
    all_ = {};
  }
  if (keeps_) all_.push_back(std::move(part.all));
}

std::vector<TriangleD> SceneMemory::take_all() {
  std::vector<std::size_t> begins;
  std::size_t count = 0;
  for (const std::vector<TriangleD>& some : all_) {
    begins.push_back(count);
    count += some.size();
  }
  std::vector<TriangleD> all(count);
  parallel_for(std::int64_t(all_.size()), [&](std::int64_t i) {
    std::vector<TriangleD>& some = all_[std::size_t(i)];
    std::copy(some.begin(), some.end(), all.begin() + std::ptrdiff_t(begins[std::size_t(i)]));
    some = {};
  });
  all_ = {};
  return all;
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
