#pragma once
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "lib/core/indexed_mesh.h"

/// Cages for tests: closed, facing outwards.
namespace bp::test {

struct NamedCage {
  std::string name;
  IndexedMesh mesh;
};

/// A prism over a polygon that turns left; its two ends are fans around corner 0, so the polygon must be star-shaped
/// from there.
inline IndexedMesh prism(const std::vector<std::array<double, 2>>& polygon, double height) {
  IndexedMesh m;
  const auto n = std::uint32_t(polygon.size());
  for (const double z : {0.0, height}) {
    for (const auto& p : polygon) m.vertices.push_back({p[0], p[1], z});
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    m.triangles.push_back({0, i + 1, i});
    m.triangles.push_back({n, n + i, n + i + 1});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    m.triangles.push_back({i, j, n + j});
    m.triangles.push_back({i, n + j, n + i});
  }
  return m;
}

/// A sphere of rings and meridians, its points moved in and out by `spikes`.
inline IndexedMesh sphere_cage(std::uint32_t rings, std::uint32_t meridians, double spikes = 0) {
  IndexedMesh m;
  m.vertices.push_back({0, 0, 1});
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t j = 0; j < meridians; ++j) {
      const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / meridians;
      const double r = (i + j) % 2 == 0 ? 1 : 1 - spikes;
      m.vertices.push_back({r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a)});
    }
  }
  m.vertices.push_back({0, 0, -1});
  const auto last = std::uint32_t(m.vertices.size() - 1);
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i == 0 ? 0 : i == rings ? last : 1 + (i - 1) * meridians + j % meridians;
  };
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < meridians; ++j) {
      if (i + 1 < rings) m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

/// Coplanar quads, concave ones, needles, slivers, a fin, and a well-shaped one.
inline std::vector<NamedCage> hostile_cages() {
  return {{"cube", prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1)},
          {"L", prism({{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}}, 1)},
          {"concave", prism({{1, 0.2}, {2, 1}, {1, 0.9}, {0, 1}}, 0.7)},
          {"needle", prism({{0, 0}, {1e-3, 0}, {0, 1e-3}}, 1)},
          {"plate", prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1e-4)},
          {"slivers", sphere_cage(40, 3)},
          {"spikes", sphere_cage(8, 10, 0.7)},
          {"sphere", sphere_cage(12, 14)}};
}

}  // namespace bp::test
