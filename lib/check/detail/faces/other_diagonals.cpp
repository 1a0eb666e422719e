#include "lib/check/detail/faces/other_diagonals.h"

#include <algorithm>
#include <atomic>
#include <set>

#include "lib/check/detail/surface.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/exact/triangle_intersection.h"

namespace bp {

namespace {

std::array<std::uint32_t, 2> ends_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

bool is_flat(std::span<const TriangleD> polygon) {
  if (!std::all_of(polygon.begin(), polygon.end(), [](const TriangleD& t) { return is_finite(t); })) return false;
  const auto plane =
      std::find_if(polygon.begin(), polygon.end(), [](const TriangleD& t) { return !collinear(t[0], t[1], t[2]); });
  if (plane == polygon.end()) return true;
  const TriangleD& a = *plane;
  const auto is_in_plane = [&](const Vec3d& p) {
    return p == a[0] || p == a[1] || p == a[2] || orient3d(a[0], a[1], a[2], p) == 0;
  };
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const TriangleD& t) { return std::all_of(t.begin(), t.end(), is_in_plane); });
}

OtherDiagonals other_diagonals(const IndexedMesh& proxy) {
  OtherDiagonals out;
  std::vector<TriangleD> polygon;
  for (std::size_t t = 0; t < proxy.inner_edges.size(); ++t) {
    polygon.clear();
    const std::size_t first = t;
    const auto add = [&] {
      TriangleD corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = proxy.vertices[proxy.triangles[t][k]];
      polygon.push_back(corners);
    };
    for (add(); (proxy.inner_edges[t] & kSamePolygonAfter) != 0 && t + 1 < proxy.inner_edges.size(); add()) ++t;
    if (polygon.size() < 2 || is_flat(polygon)) continue;
    if (polygon.size() > 2) {
      ++out.larger;
      continue;
    }
    if (out.mesh.vertices.empty()) out.mesh = proxy;
    const std::array<std::uint32_t, 3> a = proxy.triangles[first];
    const std::uint32_t last = proxy.triangles[t][2];
    out.quads.push_back(std::uint32_t(first));
    out.mesh.triangles[first] = {a[0], a[1], last};
    out.mesh.triangles[t] = {a[1], a[2], last};
  }
  return out;
}

bool may_be_mixed(const IndexedMesh& proxy, const OtherDiagonals& others) {
  const std::size_t read = proxy.triangles.size();
  IndexedMesh both = proxy;
  for (const std::uint32_t t : others.quads)
    both.triangles.insert(both.triangles.end(), {others.mesh.triangles[t], others.mesh.triangles[t + 1]});
  CheckReport ignored;
  const WeldedMesh mesh = weld(both, 0, ignored);
  if (mesh.triangles.size() != both.triangles.size()) return false;
  std::set<std::array<std::uint32_t, 2>> edges;
  for (std::size_t t = 0; t < read; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    edges.insert({ends_of(a, b), ends_of(b, c), ends_of(c, a)});
  }
  const Surface surface(mesh);
  std::atomic<bool> fine = true;
  parallel_for(std::int64_t(others.quads.size()), [&](std::int64_t i) {
    const std::uint32_t quad = others.quads[std::size_t(i)];
    for (std::size_t t = read + 2 * std::size_t(i); t < read + 2 * std::size_t(i) + 2; ++t) {
      const auto& corners = mesh.triangles[t];
      if (edges.contains(ends_of(corners[t % 2 == read % 2 ? 1 : 0], corners[2]))) fine = false;
      const bool meets = surface.bvh().visit(bounds_of(mesh.corners(t)), [&](const TriangleBvh::Item& item) {
        const std::uint32_t other = surface.triangle(item.id);
        return other < read && other != quad && other != quad + 1 &&
               triangles_meet_beyond_shared(mesh.points.data(), corners, mesh.triangles[other]);
      });
      if (meets) fine = false;
    }
  });
  return fine;
}

}  // namespace bp
