#include "lib/levels/detail/convex_levels.h"

#include <array>
#include <cmath>
#include <utility>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

/// Returns the box, which is larger than `bounds` by `off` and one or two lattice units on each side.
LodLevel box_level(const LodLevel& place, const Bounds3d& bounds, double off) {
  const GridFrame& frame = place.mesh.frame;
  LatticeMesh box;
  const Vec3d lo = frame.to_voxels(bounds.min), hi = frame.to_voxels(bounds.max);
  std::array<LatticeCoord, 2> ends;
  for (int i = 0; i < 3; ++i) {
    ends[0][i] = std::int64_t(std::floor(lo[std::size_t(i)] * kLatticePerVoxel - off)) - 1;
    ends[1][i] = std::int64_t(std::ceil(hi[std::size_t(i)] * kLatticePerVoxel + off)) + 1;
  }
  for (std::size_t i = 0; i < 8; ++i) box.vertices.push_back({ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z});
  box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return convex_level(place, box);
}

}  // namespace

std::vector<ConvexLevel> convex_levels(const LodLevel& place, const Bounds3d& bounds, std::span<const Vec3d> corners,
                                       double off, std::uint64_t faces) {
  std::vector<ConvexLevel> levels;
  const auto add = [&](const char* way, std::optional<LodLevel> level) {
    if (level) levels.push_back({way, std::move(*level)});
  };
  if (faces >= kFacesOfBox) add("box", box_level(place, bounds, off));
  add("prism", prism_level(place, corners, off, faces));
  add("hull", hull_level(place, corners, off, faces));
  return levels;
}

std::vector<Vec3d> scene_corners(const GridFrame& frame, std::span<const TriangleD> scene) {
  constexpr std::size_t kMost = std::size_t(1) << 20;
  std::vector<Vec3d> corners;
  if (scene.size() > kMost) return corners;
  corners.reserve(3 * scene.size());
  for (const TriangleD& t : scene) {
    for (const Vec3d& p : t) corners.push_back(frame.to_lattice(p));
  }
  return corners;
}

LodLevel convex_level(const LodLevel& place, const LatticeMesh& mesh) {
  LodLevel out;
  out.mesh.frame = place.mesh.frame;
  out.mesh.provenance = place.mesh.provenance;
  out.mesh.vertices = mesh.vertices;
  out.mesh.triangles = mesh.triangles;
  out.scale_world = place.scale_world;
  out.reductions = place.reductions;
  out.attempts = place.attempts;
  LevelCounts& counts = out.counts.levels.emplace_back();
  counts.measures.shells = 1;
  counts.measures.volume = double(volume6_of(out.mesh)) / 6 * std::pow(out.mesh.frame.voxel / kLatticePerVoxel, 3);
  counts.stopped_by = to_string(StopReason::least_volume);
  counts.simplify.faces_out = out.mesh.triangles.size();
  return out;
}

}  // namespace bp
