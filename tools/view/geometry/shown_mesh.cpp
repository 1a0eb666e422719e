#include "tools/view/geometry/shown_mesh.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/geometry/smooth_normals.h"

namespace bp {

namespace {

template <class T>
void append_all(std::string& out, const std::vector<T>& values) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::array<float, 3> moved(const Vec3d& p, const Vec3d& shift) {
  return {float(p[0] + shift[0]), float(p[1] + shift[1]), float(p[2] + shift[2])};
}

/// Returns the edges of faces, each once.
std::vector<std::array<std::uint32_t, 2>> edges_of(const IndexedMesh& mesh, const std::vector<std::uint32_t>& kept) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(kept.size() * 3);
  for (const std::uint32_t t : kept) {
    const unsigned inner = t < mesh.inner_edges.size() ? mesh.inner_edges[t] : 0U;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if ((inner >> k & 1U) == 0) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

ShownMesh::Direction packed_direction(const Vec3d& n) {
  const double size = length(n);
  ShownMesh::Direction out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::int8_t(size > 0 ? std::lround(127 * n[i] / size) : 0);
  return out;
}

std::string ShownMesh::bytes() const {
  std::string out;
  out.reserve(24 + positions.size() * 20 + triangles.size() * 12 + edges.size() * 8);
  append_all(out, std::vector<std::uint32_t>{std::uint32_t(positions.size()), std::uint32_t(normals.size()),
                                             std::uint32_t(triangles.size()), std::uint32_t(edges.size()),
                                             std::uint32_t(distances.size()), faces});
  append_all(out, positions);
  append_all(out, normals);
  append_all(out, triangles);
  append_all(out, edges);
  append_all(out, distances);
  return out;
}

ShownMesh shown_mesh(const IndexedMesh& mesh, const Vec3d& shift) {
  ShownMesh out;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    if (!std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return v < mesh.vertices.size(); })) continue;
    out.triangles.push_back(t);
    kept.push_back(i);
  }
  out.positions.reserve(mesh.vertices.size());
  for (const Vec3d& p : mesh.vertices) out.positions.push_back(moved(p, shift));
  out.edges = edges_of(mesh, kept);
  out.faces = std::uint32_t(out.triangles.size());
  return out;
}

ShownMesh shown_smooth(const std::vector<TriangleD>& triangles, const Vec3d& shift) {
  ShownMesh out;
  out.faces = std::uint32_t(triangles.size());
  out.normals.reserve(triangles.size() * 3);
  for (const auto& corners : smooth_normals(triangles)) {
    for (const PackedNormal n : corners) out.normals.push_back(packed_direction(unpack_normal(n)));
  }
  out.positions.reserve(out.normals.size());
  for (const TriangleD& t : triangles) {
    for (const Vec3d& p : t) out.positions.push_back(moved(p, shift));
  }
  return out;
}

}  // namespace bp
