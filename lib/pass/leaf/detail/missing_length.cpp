#include "lib/pass/leaf/detail/missing_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "lib/core/vec3.h"

namespace bp {

namespace {

/// A triangle that is gone, and how far it is from what is left.
struct Missing {
  TriangleD triangle;
  double distance = 0;
};

/// Calls f(point, area) for small parts of a triangle, of about the edge `size`, but at most 4096.
template <class F>
void for_each_part(const TriangleD& t, double size, const F& f) {
  constexpr double kMostCuts = 64, kThird = 1.0 / 3;
  const double longest = std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
  const int n = int(std::clamp(std::ceil(longest / size), 1.0, kMostCuts));
  const double part = area_of(t) / (double(n) * n);
  const auto at = [&](double a, double b) { return t[0] + (a / n) * (t[1] - t[0]) + (b / n) * (t[2] - t[0]); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      f(at(i + kThird, j + kThird), part);
      if (i + j + 1 < n) f(at(i + 2 * kThird, j + 2 * kThird), part);
    }
  }
}

/// Returns whether surface that is farther than half of `side` half fills a square of that side.
bool half_fills(std::span<const Missing> surface, double side) {
  std::map<std::array<std::int64_t, 3>, double> areas;
  for (const Missing& m : surface) {
    if (m.distance < side / 2) continue;
    for_each_part(m.triangle, side, [&](const Vec3d& p, double area) {
      std::array<std::int64_t, 3> cell{};
      for (std::size_t i = 0; i < 3; ++i) cell[i] = std::int64_t(std::floor(p[i] / side));
      areas[cell] += area;
    });
  }
  return std::any_of(areas.begin(), areas.end(), [&](const auto& a) { return 2 * a.second >= side * side; });
}

/// Returns the distance of the triangle's farthest corner, or its middle, from what is left.
double distance_of(const TriangleD& t, const TriangleBvh& left, std::uint32_t& guess) {
  double squared = 0;
  const Vec3d middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
  for (const Vec3d& p : {t[0], t[1], t[2], middle}) {
    const TriangleBvh::Nearest nearest = left.nearest(p, guess);
    guess = nearest.item;
    squared = std::max(squared, nearest.distance_squared);
  }
  return std::sqrt(squared);
}

}  // namespace

double missing_length(std::span<const TriangleD> gone, const TriangleBvh& left) {
  constexpr double kLeast = 1.0 / 4096, kStep = std::numbers::sqrt2;
  std::vector<Missing> surface;
  double area = 0, farthest = 0;
  std::uint32_t guess = 0;
  for (const TriangleD& t : gone) {
    surface.push_back({t, distance_of(t, left, guess)});
    area += area_of(t);
    farthest = std::max(farthest, surface.back().distance);
  }
  const double most = std::min(std::sqrt(2 * area), 2 * farthest);
  for (double side = most; side > kLeast * most; side /= kStep) {
    if (half_fills(surface, side)) return std::min(side * kStep, most) / 2;
  }
  return 0;
}

}  // namespace bp
