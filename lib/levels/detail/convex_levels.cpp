#include "lib/levels/detail/convex_levels.h"

#include <array>
#include <cmath>
#include <utility>

#include "lib/levels/detail/hull_level.h"
#include "lib/levels/detail/prism_level.h"

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

}  // namespace bp
