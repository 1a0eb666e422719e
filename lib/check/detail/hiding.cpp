#include "lib/check/detail/hiding.h"

#include <algorithm>
#include <array>

#include "lib/check/detail/edge_sum.h"
#include "lib/check/detail/mesh_topology.h"
#include "lib/core/parallel.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/crossing.h"

namespace bp {

namespace {

constexpr std::uint64_t kBytesPerTriangle = 400;  // bytes of a triangle as read, and welded
constexpr int kWays = 6;

/// Turns p so that axis way / 2 points up; for odd ways, down.
Vec3d turned(const Vec3d& p, int way) {
  const auto axis = std::size_t(way / 2);
  const Vec3d q{p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]};
  return way % 2 == 0 ? q : Vec3d{-q[0], -q[1], -q[2]};
}

/// Returns whether the triangle lies in front of the point for an eye that looks against the way.
bool covers(const TriangleD& t, const Vec3d& point, int way) {
  const auto axis = std::size_t(way / 2);
  for (const std::size_t i : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (std::min({t[0][i], t[1][i], t[2][i]}) > point[i] || std::max({t[0][i], t[1][i], t[2][i]}) < point[i])
      return false;
  }
  return crossing_above({turned(t[0], way), turned(t[1], way), turned(t[2], way)}, turned(point, way)) != 0;
}

/// Closed shells, and their winding numbers around the points.
class Shells {
 public:
  Shells(IndexedMesh soup, const std::vector<Vec3d>& points) {
    CheckReport unused;
    WeldedMesh mesh = weld(soup, 0, unused);
    soup = {};
    check_topology(mesh, 0, unused);
    const EdgeKey key = EdgeKey::drawn();
    std::vector<EdgeSum> edges;
    std::vector<std::uint32_t> shells = mesh.component;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.degenerate[t] != 0) continue;
      edges.resize(std::max(edges.size(), std::size_t(shells[t]) + 1), EdgeSum(key));
      edges[shells[t]].add(mesh.corners(t));
    }
    enclosed_.assign(points.size(), 0);
    parallel_for(std::int64_t(points.size()), [&](std::int64_t i) {
      std::vector<std::int64_t> windings(edges.size());
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.degenerate[t] == 0) windings[shells[t]] += crossing_above(mesh.corners(t), points[std::size_t(i)]);
      }
      for (std::size_t s = 0; s < edges.size(); ++s) {
        if (edges[s].zero() && windings[s] != 0) enclosed_[std::size_t(i)] = 1;
      }
    });
  }
  [[nodiscard]] bool enclose(std::size_t point) const { return enclosed_[point] != 0; }

 private:
  std::vector<char> enclosed_;
};

void add_triangle(const TriangleD& t, IndexedMesh& soup) {
  const auto n = std::uint32_t(soup.vertices.size());
  for (const Vec3d& p : t) soup.vertices.push_back(p);
  soup.triangles.push_back({n, n + 1, n + 2});
}

}  // namespace

std::vector<Hiding> hiding_of(const std::vector<Vec3d>& points, TriangleSource& scene, std::uint64_t memory_bytes) {
  std::vector<std::array<bool, kWays>> covered(points.size());
  IndexedMesh soup;
  bool fits = true;
  scene.rewind();
  for (std::vector<TriangleD> chunk; scene.read(chunk);) {
    std::erase_if(chunk, [](const TriangleD& t) {
      return !in_predicate_domain(t[0]) || !in_predicate_domain(t[1]) || !in_predicate_domain(t[2]);
    });
    parallel_for(std::int64_t(points.size()), [&](std::int64_t i) {
      for (int way = 0; way < kWays; ++way) {
        bool& hit = covered[std::size_t(i)][std::size_t(way)];
        for (std::size_t k = 0; k < chunk.size() && !hit; ++k) hit = covers(chunk[k], points[std::size_t(i)], way);
      }
    });
    fits = fits && (soup.triangles.size() + chunk.size()) * kBytesPerTriangle <= memory_bytes;
    if (!fits) soup = {};
    for (std::size_t k = 0; k < chunk.size() && fits; ++k) add_triangle(chunk[k], soup);
  }
  std::vector<Hiding> all;
  for (const auto& ways : covered)
    all.push_back(std::find(ways.begin(), ways.end(), false) != ways.end() ? Hiding::seen : Hiding::unknown);
  if (!fits || std::find(all.begin(), all.end(), Hiding::unknown) == all.end()) return all;
  const Shells shells(std::move(soup), points);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] == Hiding::unknown && shells.enclose(i)) all[i] = Hiding::enclosed;
  }
  return all;
}

}  // namespace bp
