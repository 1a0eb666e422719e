#include "lib/geometry/welded_triangles.h"

#include <algorithm>
#include <compare>
#include <functional>
#include <numeric>

#include "lib/geometry/parallel_sort.h"

namespace bp {

namespace {

/// One half of an edge. Sorted by these, the halves of an edge follow each other.
struct EdgeSide {
  std::uint32_t low, high, half_edge;
  bool up;
  auto operator<=>(const EdgeSide&) const = default;
};

}  // namespace

WeldedTriangles welded(std::span<const TriangleD> triangles) {
  std::vector<std::uint32_t> order(3 * triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) -> const Vec3d& { return triangles[i / 3][i % 3]; };
  // Corners at one place are ordered by their numbers, so that of 0 and -0 always the same one is kept.
  parallel_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto by_place = place(a) <=> place(b);
    return by_place != 0 ? by_place < 0 : a < b;
  });
  WeldedTriangles mesh;
  mesh.triangles.resize(triangles.size());
  for (const std::uint32_t i : order) {
    if (mesh.places.empty() || mesh.places.back() != place(i)) mesh.places.push_back(place(i));
    mesh.triangles[i / 3][i % 3] = std::uint32_t(mesh.places.size() - 1);
  }
  return mesh;
}

std::vector<std::uint32_t> twins_of(std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t h = 0; h < 3 * triangles.size(); ++h) {
    const std::uint32_t a = triangles[h / 3][h % 3], b = triangles[h / 3][(h + 1) % 3];
    if (a != b) sides.push_back({std::min(a, b), std::max(a, b), h, a < b});
  }
  parallel_sort(sides, std::less<>());
  std::vector<std::uint32_t> twins(3 * triangles.size(), kNoTwin);
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    for (end = i + 1; end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high;) ++end;
    if (end != i + 2 || sides[i].up == sides[i + 1].up) continue;
    twins[sides[i].half_edge] = sides[i + 1].half_edge;
    twins[sides[i + 1].half_edge] = sides[i].half_edge;
  }
  return twins;
}

}  // namespace bp
