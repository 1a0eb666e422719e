#include "lib/enclosed/detail/triangle_samples.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

void add_samples(const TriangleD& t, double voxel, std::vector<Vec3d>& points) {
  constexpr double kSpacingVox = 8;
  constexpr int kMostPerEdge = 16;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d e = t[(k + 1) % 3] - t[k];
    longest = std::max(longest, dot(e, e));
  }
  const int n = int(std::clamp(std::sqrt(longest) / (kSpacingVox * voxel), 1.0, double(kMostPerEdge)));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j)
      points.push_back(t[0] + (double(i) / n) * (t[1] - t[0]) + (double(j) / n) * (t[2] - t[0]));
  }
}

// Sorts by slabs of the first coordinate: each slab has few points, and all threads have slabs.
std::vector<Vec3d> each_once(const std::vector<Vec3d>& points) {
  constexpr std::size_t kPointsPerSlab = 64;
  if (points.empty()) return {};
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const Vec3d& a, const Vec3d& b) { return a[0] < b[0]; });
  const double first = (*low)[0], extent = (*high)[0] - first;
  const std::size_t slabs = extent > 0 && std::isfinite(extent) ? points.size() / kPointsPerSlab + 1 : 1;
  std::vector<std::uint32_t> slab_of(points.size(), 0);
  parallel_ranges(std::int64_t(points.size()), kSamplesAtOnce, [&](std::int64_t from, std::int64_t to) {
    for (auto i = std::size_t(from); slabs > 1 && i < std::size_t(to); ++i)
      slab_of[i] = std::uint32_t(std::min(std::size_t((points[i][0] - first) / extent * double(slabs)), slabs - 1));
  });
  std::vector<std::size_t> begin(slabs + 1, 0);
  for (const std::uint32_t s : slab_of) ++begin[s + 1];
  for (std::size_t i = 0; i < slabs; ++i) begin[i + 1] += begin[i];
  std::vector<Vec3d> sorted(points.size());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) sorted[end[slab_of[i]]++] = points[i];
  const auto at = [&](std::size_t i) { return sorted.begin() + std::ptrdiff_t(i); };
  parallel_ranges(std::int64_t(slabs), std::int64_t(kPointsPerSlab), [&](std::int64_t from, std::int64_t to) {
    for (auto i = std::size_t(from); i < std::size_t(to); ++i) {
      std::sort(at(begin[i]), at(begin[i + 1]));
      end[i] = std::size_t(std::unique(at(begin[i]), at(begin[i + 1])) - sorted.begin());
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < slabs; ++i)
    kept = std::size_t(std::copy(at(begin[i]), at(end[i]), at(kept)) - sorted.begin());
  sorted.resize(kept);
  return sorted;
}

}  // namespace bp
