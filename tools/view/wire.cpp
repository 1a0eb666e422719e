#include "tools/view/wire.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kSmoothCosine = 0.766;  // cosine of 40 degrees

template <class T>
void append(std::string& out, std::span<const T> values) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void append(std::string& out, const T& value) {
  append(out, std::span<const T>(&value, 1));
}

void append_position(std::string& out, const Vec3d& p, const Vec3d& middle) {
  for (std::size_t i = 0; i < 3; ++i) append(out, float(p[i] - middle[i]));
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

using PackedDirection = std::array<std::int8_t, 4>;

PackedDirection packed(const Vec3d& n) {
  const double size = length(n);
  PackedDirection out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::int8_t(size > 0 ? std::lround(127 * n[i] / size) : 0);
  return out;
}

}  // namespace

std::string surface_bytes(const std::vector<LiveClosing::Piece>& pieces, std::uint64_t generation) {
  std::string out;
  append(out, std::uint32_t(generation));
  append(out, std::uint32_t(pieces.size()));
  for (const LiveClosing::Piece& piece : pieces) {
    const SurfacePiece& s = *piece.surface;
    for (int axis = 0; axis < 3; ++axis) append(out, s.brick[axis]);
    append(out, std::uint32_t(s.vertices.size()));
    append(out, std::uint32_t(s.triangles.size()));
    append(out, std::span(s.vertices));
    append(out, std::span(s.triangles));
  }
  return out;
}

std::string mesh_bytes(const IndexedMesh& mesh, const Vec3d& middle) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : mesh.triangles) {
    if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return v < mesh.vertices.size(); }))
      triangles.push_back(t);
  }
  std::string out;
  append(out, std::uint32_t(mesh.vertices.size()));
  append(out, std::uint32_t(triangles.size()));
  for (const Vec3d& p : mesh.vertices) append_position(out, p, middle);
  append(out, std::span<const std::array<std::uint32_t, 3>>(triangles));
  return out;
}

std::string scene_bytes(const std::vector<TriangleD>& triangles, const Vec3d& middle) {
  const Places places = places_of(triangles);
  std::vector<PackedDirection> normals(triangles.size() * 3);
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
      normals[c] = packed(sum);
    }
  });
  std::string out;
  out.reserve(8 + normals.size() * 16);
  append(out, std::uint32_t(normals.size()));
  append(out, std::uint32_t(0));
  for (const TriangleD& t : triangles) {
    for (const Vec3d& p : t) append_position(out, p, middle);
  }
  append(out, std::span<const PackedDirection>(normals));
  return out;
}

}  // namespace bp
