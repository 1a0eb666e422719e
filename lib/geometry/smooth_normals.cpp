#include "lib/geometry/smooth_normals.h"

#include <algorithm>
#include <numeric>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kSmoothCosine = 0.766;   // cosine of 40 degrees
constexpr std::uint32_t kMostInFan = 64;  // triangles: a fan of more is flat enough

/// The corners sorted by place: numbers 3 t + k of corner k of triangle t, and where each place begins.
struct Places {
  std::vector<std::uint32_t> corners, place_of, begins;
};

Places places_of(std::span<const TriangleD> triangles) {
  Places out;
  out.corners.resize(triangles.size() * 3);
  std::iota(out.corners.begin(), out.corners.end(), 0U);
  const auto at = [&](std::uint32_t c) -> const Vec3d& { return triangles[c / 3][c % 3]; };
  std::sort(out.corners.begin(), out.corners.end(),
            [&](std::uint32_t a, std::uint32_t b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  out.place_of.resize(out.corners.size());
  for (std::size_t i = 0; i < out.corners.size(); ++i) {
    if (i == 0 || at(out.corners[i]) != at(out.corners[i - 1])) out.begins.push_back(std::uint32_t(i));
    out.place_of[out.corners[i]] = std::uint32_t(out.begins.size() - 1);
  }
  out.begins.push_back(std::uint32_t(out.corners.size()));
  return out;
}

Vec3d cross_of(const TriangleD& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

}  // namespace

std::vector<std::array<PackedNormal, 3>> smooth_normals(std::span<const TriangleD> triangles) {
  const Places places = places_of(triangles);
  std::vector<std::array<PackedNormal, 3>> normals(triangles.size());
  parallel_ranges(std::int64_t(triangles.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = std::size_t(begin) * 3; c < std::size_t(end) * 3; ++c) {
      const Vec3d own = cross_of(triangles[c / 3]);
      const std::uint32_t place = places.place_of[c];
      const std::uint32_t last = std::min(places.begins[place + 1], places.begins[place] + kMostInFan);
      Vec3d sum = own;
      for (std::uint32_t i = places.begins[place]; i < last; ++i) {
        if (places.corners[i] / 3 == c / 3) continue;
        const Vec3d other = cross_of(triangles[places.corners[i] / 3]);
        if (dot(own, other) > kSmoothCosine * length(own) * length(other)) sum = sum + other;
      }
      normals[c / 3][c % 3] = pack_normal(sum);
    }
  });
  return normals;
}

}  // namespace bp
