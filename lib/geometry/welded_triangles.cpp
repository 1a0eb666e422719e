#include "lib/geometry/welded_triangles.h"

#include <algorithm>
#include <numeric>

namespace bp {

WeldedTriangles welded(std::span<const TriangleD> triangles) {
  std::vector<std::uint32_t> order(3 * triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) -> const Vec3d& { return triangles[i / 3][i % 3]; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  WeldedTriangles mesh;
  mesh.triangles.resize(triangles.size());
  for (const std::uint32_t i : order) {
    if (mesh.places.empty() || mesh.places.back() != place(i)) mesh.places.push_back(place(i));
    mesh.triangles[i / 3][i % 3] = std::uint32_t(mesh.places.size() - 1);
  }
  return mesh;
}

}  // namespace bp
