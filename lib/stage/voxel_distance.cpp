#include "lib/stage/voxel_distance.h"

#include <cmath>

#include "lib/geometry/surface_distance.h"

namespace bp {

namespace {

const double kSegmentToPoint = std::sqrt(1.5);  // from a point of the segment to any point of its voxel, in voxels
const double kPointToSegment = std::sqrt(0.5);
constexpr double kTolerance = 0.5;  // of the search, in voxels

}  // namespace

std::vector<TriangleD> segments_of(std::span<const VoxelRun> runs, const GridFrame& frame) {
  constexpr std::int64_t kHalf = kLatticePerVoxel / 2;
  std::vector<TriangleD> segments;
  segments.reserve(runs.size());
  for (const VoxelRun& run : runs) {
    const LatticeCoord a{std::int64_t(run.first.x) * kLatticePerVoxel,
                         std::int64_t(run.first.y) * kLatticePerVoxel + kHalf,
                         std::int64_t(run.first.z) * kLatticePerVoxel + kHalf};
    const LatticeCoord b{a.x + run.length * kLatticePerVoxel, a.y, a.z};
    segments.push_back({frame.world(a), frame.world(b), frame.world(b)});
  }
  return segments;
}

double distance_from_mesh(const std::vector<TriangleD>& mesh, const TriangleBvh& segments, double voxel) {
  return surface_distance(mesh, segments, kTolerance * voxel).at_most + kSegmentToPoint * voxel;
}

double distance_to_mesh(const std::vector<TriangleD>& segments, const std::vector<TriangleD>& mesh, double voxel) {
  if (segments.empty()) return 0;
  return surface_distance(segments, TriangleBvh(mesh), kTolerance * voxel).at_most + kPointToSegment * voxel;
}

}  // namespace bp
