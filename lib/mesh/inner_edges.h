#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace bp {

/// Calls body(c, d) for each edge that exactly two triangles have. c < d are the corners where the edge begins in each,
/// as 3 * triangle + place. The order depends on the triangles only. O(n log n), 36 bytes a triangle.
template <class Body>
void for_each_inner_edge(std::span<const std::array<std::uint32_t, 3>> triangles, const Body& body) {
  struct HalfEdge {
    std::uint32_t low, high, corner;
    bool operator<(const HalfEdge& e) const { return std::tie(low, high, corner) < std::tie(e.low, e.high, e.corner); }
  };
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), 3 * t + k});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    for (end = i + 1; end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high;) ++end;
    if (end == i + 2) body(edges[i].corner, edges[i + 1].corner);
  }
}

}  // namespace bp
