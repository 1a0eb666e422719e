#include "lib/levels/detail/few_faces_level.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"

namespace bp {

namespace {

constexpr std::uint64_t kFew = 32;  // with more, the way that keeps near the scene is nearest as a rule
constexpr double kClearlyNearer = 0.9;

}  // namespace

bool is_of_few_faces(const LodTarget& target) {
  return target.faces > 0 && target.faces < kFew && target.error_world == 0;
}

bool has_few_faces(const LodLevel& level) {
  return level.mesh.triangles.size() < kFew;
}

bool may_have_faces(const LodLevel& level, std::uint64_t faces) {
  constexpr std::uint64_t kFewMore = 8;
  const MeshMeasures& measures = level.counts.levels.front().measures;
  const std::uint64_t parts = measures.shells + measures.handles;
  return 4 * parts <= faces && (parts == 1 || level.mesh.triangles.size() <= 2 * faces + kFewMore);
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

LodLevel convex_level(const LodLevel& level, const LatticeMesh& mesh) {
  LodLevel out;
  out.mesh.frame = level.mesh.frame;
  out.mesh.provenance = level.mesh.provenance;
  out.mesh.vertices = mesh.vertices;
  out.mesh.triangles = mesh.triangles;
  out.scale_world = level.scale_world;
  out.reductions = level.reductions;
  out.attempts = level.attempts;
  out.counts = level.counts;
  LevelCounts& counts = out.counts.levels.front();
  counts.measures = {};
  counts.measures.shells = 1;
  counts.measures.volume = double(volume6_of(out.mesh)) / 6 * std::pow(out.mesh.frame.voxel / kLatticePerVoxel, 3);
  counts.stopped_by = to_string(StopReason::least_volume);
  counts.simplify.faces_out = out.mesh.triangles.size();
  return out;
}

LodLevel box_level(const LodLevel& level, const Bounds3d& bounds) {
  const GridFrame& frame = level.mesh.frame;
  LatticeMesh box;
  const Vec3d lo = frame.to_voxels(bounds.min), hi = frame.to_voxels(bounds.max);
  std::array<LatticeCoord, 2> ends;
  for (int i = 0; i < 3; ++i) {
    ends[0][i] = std::int64_t(std::floor(lo[std::size_t(i)] * kLatticePerVoxel)) - 1;
    ends[1][i] = std::int64_t(std::ceil(hi[std::size_t(i)] * kLatticePerVoxel)) + 1;
  }
  for (std::size_t i = 0; i < 8; ++i) box.vertices.push_back({ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z});
  box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return convex_level(level, box);
}

bool may_be_near(const LodLevel& convex, std::span<const Vec3d> corners, double near) {
  double largest = 0;
  Vec3d middle{};
  for (const auto& [i, j, k] : convex.mesh.triangles) {
    const auto& v = convex.mesh.vertices;
    const Vec3d a = to_double(v[i]), b = to_double(v[j]), c = to_double(v[k]);
    const double area = length(cross(b - a, c - a));
    if (area > largest) largest = area, middle = (1.0 / 3) * (a + b + c);
  }
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    if (distance_squared(middle, {corners[i], corners[i + 1], corners[i + 2]}) <= near * near) return true;
  }
  return false;
}

bool holds_no_more(const LodLevel& level, const LodLevel& other, double share) {
  return volume_of(level) <= (1 + share) * volume_of(other);
}

bool is_better(const LodLevel& level, const LodLevel& other, std::uint64_t faces) {
  const bool reached = level.mesh.triangles.size() <= faces;
  if (reached != (other.mesh.triangles.size() <= faces)) return reached;
  return level.error_world < other.error_world;
}

bool is_better_box(const LodLevel& box, const LodLevel& other, std::uint64_t faces) {
  if (!is_better(box, other, faces)) return false;
  return other.mesh.triangles.size() > faces || holds_no_more(box, other) ||
         box.error_world < kClearlyNearer * other.error_world;
}

}  // namespace bp
