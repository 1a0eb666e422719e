#include "lib/levels/detail/convex_level.h"

#include <cmath>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

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
