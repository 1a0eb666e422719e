#include "tools/view/geometry/shown_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kSmoothCosine = 0.766;  // cosine of 40 degrees

template <class T>
void append_all(std::string& out, const std::vector<T>& values) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::array<float, 3> moved(const Vec3d& p, const Vec3d& shift) {
  return {float(p[0] + shift[0]), float(p[1] + shift[1]), float(p[2] + shift[2])};
}

/// The corners sorted by place: numbers 3 t + k of corner k of triangle t, and where each place begins.
struct Places {
  std::vector<std::uint32_t> corners, place_of, begins;
};

Places places_of(const std::vector<TriangleD>& triangles) {
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
  out.reserve(20 + positions.size() * 20 + triangles.size() * 12 + edges.size() * 8);
  append_all(out, std::vector<std::uint32_t>{std::uint32_t(positions.size()), std::uint32_t(normals.size()),
                                             std::uint32_t(triangles.size()), std::uint32_t(edges.size()),
                                             std::uint32_t(distances.size())});
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
  return out;
}

ShownMesh shown_smooth(const std::vector<TriangleD>& triangles, const Vec3d& shift) {
  const Places places = places_of(triangles);
  ShownMesh out;
  out.normals.resize(triangles.size() * 3);
  parallel_ranges(std::int64_t(triangles.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = std::size_t(begin) * 3; c < std::size_t(end) * 3; ++c) {
      const Vec3d own = cross_of(triangles[c / 3]);
      const std::uint32_t place = places.place_of[c];
      constexpr std::uint32_t kMost = 64;  // triangles: a fan of more is flat enough
      const std::uint32_t last = std::min(places.begins[place + 1], places.begins[place] + kMost);
      Vec3d sum = own;
      for (std::uint32_t i = places.begins[place]; i < last; ++i) {
        if (places.corners[i] / 3 == c / 3) continue;
        const Vec3d other = cross_of(triangles[places.corners[i] / 3]);
        if (dot(own, other) > kSmoothCosine * length(own) * length(other)) sum = sum + other;
      }
      out.normals[c] = packed_direction(sum);
    }
  });
  out.positions.reserve(out.normals.size());
  for (const TriangleD& t : triangles) {
    for (const Vec3d& p : t) out.positions.push_back(moved(p, shift));
  }
  return out;
}

}  // namespace bp
