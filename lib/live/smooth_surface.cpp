// Source: [CB17] §5.1, who filter the normals of voxels bilaterally. Here the filter works on the triangles of the
// moved corners, so that thin solids near thick ones keep the normals of their own sides.
#include "lib/live/smooth_surface.h"

#include <algorithm>
#include <functional>
#include <map>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/vertex_fans.h"
#include "lib/live/surface_piece.h"

namespace bp {

namespace {

constexpr int kRounds = 4;             // of the filter; each reaches one face of a cell farther
constexpr double kAcross = 0.03;       // weight of a neighbour at a right angle or more; 1 is that of a parallel one
constexpr double kSmoothCosine = 0.7;  // corners are shared by faces that differ by less than 45 degrees

/// A surface whose vertices are shared, across bricks, too.
struct SharedSurface {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

class Joiner {
 public:
  Joiner(double cell, const Vec3d& origin) : cell_(cell), origin_(origin) {}

  void add(const SurfacePiece& piece) {
    std::vector<std::uint32_t> number(piece.vertices.size());
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = vertex(piece, i);
    for (const auto& face : piece.faces) {
      for (const auto& t : triangles_of(face)) out_.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
  }
  SharedSurface take() { return std::move(out_); }

 private:
  /// Returns the number of a vertex. Only corners on the side of a brick may have been there before.
  std::uint32_t vertex(const SurfacePiece& piece, std::size_t i) {
    const VoxelCoord corner = piece.corners[i], first = first_voxel(piece.brick);
    const auto next = std::uint32_t(out_.vertices.size());
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner[axis] - first[axis]) % kBrickEdge != 0) continue;
      const auto [found, added] = shared_.emplace(std::array{corner.x, corner.y, corner.z}, next);
      if (!added) return found->second;
      break;
    }
    Vec3d p{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double moved = double(piece.vertices[i].position[k]) / SurfacePiece::kPerVoxel - SurfacePiece::kOrigin;
      p[k] = origin_[k] + (double(first[int(k)]) + moved) * cell_;
    }
    out_.vertices.push_back(p);
    return next;
  }

  const double cell_;
  const Vec3d origin_;
  SharedSurface out_;
  std::map<std::array<std::int32_t, 3>, std::uint32_t> shared_;
};

void for_each_triangle(std::size_t n, const std::function<void(std::size_t)>& body) {
  parallel_ranges(std::int64_t(n), 4096, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(std::size_t(i));
  });
}

/// Returns the normals of triangles, each times its area, after the filter.
std::vector<Vec3d> filtered(const SharedSurface& s, const VertexFans& fans) {
  std::vector<Vec3d> normals(s.triangles.size()), before;
  std::vector<double> areas(normals.size());
  for_each_triangle(normals.size(), [&](std::size_t i) {
    const auto& [a, b, c] = s.triangles[i];
    const Vec3d n = cross(s.vertices[b] - s.vertices[a], s.vertices[c] - s.vertices[a]);
    areas[i] = length(n);
    normals[i] = unit(n, {});
  });
  for (int round = 0; round < kRounds; ++round) {
    before = normals;
    for_each_triangle(normals.size(), [&](std::size_t i) {
      Vec3d sum{};
      for (const std::uint32_t v : s.triangles[i]) {
        for (const std::uint32_t other : fans.of(v)) {
          const double cosine = std::max(0.0, dot(before[i], before[other]));
          sum = sum + areas[other] * (kAcross + (1 - kAcross) * cosine * cosine) * before[other];
        }
      }
      normals[i] = unit(sum, before[i]);
    });
  }
  for_each_triangle(normals.size(), [&](std::size_t i) { normals[i] = areas[i] * normals[i]; });
  return normals;
}

SmoothSurface with_normals(const SharedSurface& s) {
  const VertexFans fans(s.triangles, s.vertices.size());
  const std::vector<Vec3d> normals = filtered(s, fans);
  SmoothSurface out;
  out.triangles.resize(normals.size());
  out.normals.resize(normals.size());
  for_each_triangle(normals.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = s.triangles[i][k];
      out.triangles[i][k] = s.vertices[v];
      Vec3d sum{};
      for (const std::uint32_t other : fans.of(v)) {
        const Vec3d& n = normals[other];
        if (dot(normals[i], n) >= kSmoothCosine * length(normals[i]) * length(n)) sum = sum + n;
      }
      out.normals[i][k] = pack_normal(sum);
    }
  });
  return out;
}

}  // namespace

SmoothSurface smooth_surface(const BitBox& cells, std::int32_t cell_voxels, const GridFrame& frame) {
  std::vector<BrickCoord> bricks;
  if (!cells.box().empty()) for_each(bricks_of(cells.box()), [&](BrickCoord c) { bricks.push_back(c); });
  std::vector<SurfacePiece> pieces(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { pieces[std::size_t(i)] = piece_of(cells, bricks[std::size_t(i)]); });
  Joiner joiner(cell_voxels * frame.voxel, frame.world_origin());
  for (SurfacePiece& piece : pieces) {
    joiner.add(piece);
    piece = {};
  }
  return with_normals(joiner.take());
}

}  // namespace bp
