#pragma once
#include <cmath>
#include <map>

#include "lib/check/check_proxy.h"

// Small meshes and scenes for the checks.
namespace bp::test {

/// A scene in memory that hands out `batch` triangles at a time.
class VectorSource : public TriangleSource {
 public:
  explicit VectorSource(std::vector<TriangleD> triangles, std::size_t batch = 7)
      : triangles_(std::move(triangles)), batch_(batch) {}
  bool read(std::vector<TriangleD>& out) override {
    const std::size_t end = std::min(triangles_.size(), next_ + batch_);
    out.assign(triangles_.begin() + std::ptrdiff_t(next_), triangles_.begin() + std::ptrdiff_t(end));
    counts_.triangles += out.size();
    next_ = end;
    return !out.empty();
  }
  void rewind() override { next_ = 0, counts_ = {}; }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override { return "vector"; }

 private:
  std::vector<TriangleD> triangles_;
  std::size_t batch_, next_ = 0;
  SceneCounts counts_;
};

inline std::vector<TriangleD> triangles_of(const IndexedMesh& m) {
  std::vector<TriangleD> list;
  for (const auto& t : m.triangles) list.push_back({m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]});
  return list;
}

/// Twelve triangles, outward. Vertex i: bit 0 of i chooses x, bit 1 y, bit 2 z.
inline IndexedMesh box(const Vec3d& low, const Vec3d& high) {
  IndexedMesh m;
  for (unsigned i = 0; i < 8; ++i)
    m.vertices.push_back({(i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2]});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}
inline IndexedMesh cube(double half, const Vec3d& c = {0, 0, 0}) {
  return box({c[0] - half, c[1] - half, c[2] - half}, {c[0] + half, c[1] + half, c[2] + half});
}

inline IndexedMesh join(IndexedMesh a, const IndexedMesh& b) {
  const auto shift = std::uint32_t(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}
inline IndexedMesh inverted(IndexedMesh m) {
  for (auto& t : m.triangles) std::swap(t[1], t[2]);
  return m;
}

/// An octahedron divided `levels` times and blown up: 8 * 4^levels triangles, outward.
inline IndexedMesh sphere(int levels, double radius, const Vec3d& centre = {0, 0, 0}) {
  IndexedMesh m;
  m.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto split = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), std::uint32_t(m.vertices.size()));
      if (fresh) {
        Vec3d p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = m.vertices[a][i] + m.vertices[b][i];
        const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (double& x : p) x /= length;
        m.vertices.push_back(p);
      }
      return it->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& t : m.triangles) {
      const auto ab = split(t[0], t[1]), bc = split(t[1], t[2]), ca = split(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    m.triangles = finer;
  }
  for (Vec3d& p : m.vertices)
    for (std::size_t i = 0; i < 3; ++i) p[i] = centre[i] + radius * p[i];
  return m;
}

inline CheckReport check(const IndexedMesh& proxy, std::vector<TriangleD> scene, const CheckOptions& options = {}) {
  VectorSource source(std::move(scene));
  return check_proxy(proxy, &source, options);
}
inline CheckReport check(const IndexedMesh& proxy) {
  return check_proxy(proxy, nullptr);
}

}  // namespace bp::test
