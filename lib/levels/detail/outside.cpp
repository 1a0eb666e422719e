// Where the triangles of the scene are known, and lie inside a level, the distance to all of them is the distance to
// those that are shown: what lies between a point of the level and the nearest triangle is empty, and the level lets
// the outside up to its surface. So nothing need be known of what is shown, and the voxels add no error of theirs.
#include "lib/levels/detail/outside.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/geometry/surface_distance.h"
#include "lib/levels/detail/voxel_distance.h"
#include "lib/pass/mesh/surface_around.h"

namespace bp {

namespace {

/// That measuring takes for a moment.
std::uint64_t measuring_bytes(std::uint64_t runs) {
  return runs * sizeof(TriangleD) + TriangleBvh::bytes_needed(runs);
}

}  // namespace

struct Outside::Ruler {
  double voxel;
  std::vector<TriangleD> segments;
  TriangleBvh tree;

  Ruler(const std::vector<VoxelRun>& runs, const GridFrame& frame)
      : voxel(frame.voxel), segments(segments_of(runs, frame)), tree(segments) {}

  /// `known`: no point of the level is farther from the scene.
  void measure(LodLevel& level, const std::vector<TriangleD>& triangles, MeshMode mode,
               std::optional<double> known) const {
    const TriangleBvh mesh(triangles);
    const double there = known ? *known : distance_from_mesh(triangles, tree, voxel);
    level.error_world = mode == MeshMode::fit ? distance_beyond_mesh(segments, mesh, voxel, there) : there;
    level.distance_world = std::max(there, distance_to_mesh(segments, mesh, voxel));
  }
};

Outside::Outside(const BrickShelf& solid, const BrickShelf* surface, const GridFrame& frame, const MemoryShare& memory)
    : Outside(solid, surface, frame, boundary_size(solid), memory) {}

Outside::Outside(const BrickShelf& solid, const BrickShelf* surface, const GridFrame& frame, const BoundarySize& size,
                 const MemoryShare& memory)
    : dense_faces(2 * size.faces), box(size.box), frame_(frame) {
  const std::uint64_t runs = surface != nullptr ? count_runs(*surface, box) : size.runs;
  const std::uint64_t bytes = runs * sizeof(VoxelRun) + measuring_bytes(runs);
  if (bytes > memory.bytes)
    throw NeedsMemory("measuring distances to the outside of the scene", bytes, memory.bytes,
                      memory.limit_with(bytes - memory.bytes), {Remedy::larger_voxels});
  runs_ = surface != nullptr ? runs_of(*surface, box) : boundary_of(solid).runs;
  runs_.shrink_to_fit();
  if (measuring_bytes(runs) <= memory.bytes / 16) kept_ = std::make_unique<Ruler>(runs_, frame_);
}

Outside::~Outside() = default;

std::uint64_t Outside::bytes() const {
  return runs_.capacity() * sizeof(VoxelRun) + (kept_ ? measuring_bytes(runs_.size()) : 0);
}

void Outside::measure(LodLevel& level, MeshMode mode, const std::vector<TriangleD>* enclosed) const {
  const std::vector<TriangleD> triangles = world_triangles(level.mesh);
  std::optional<double> known;  // before a ruler is made: the tree of the enclosed triangles is gone by then
  if (enclosed != nullptr)
    known = largest_distance(triangles, TriangleBvh(*enclosed), kTriangleTolerance * voxel()).at_most;
  kept_ ? kept_->measure(level, triangles, mode, known) : Ruler(runs_, frame_).measure(level, triangles, mode, known);
}

}  // namespace bp
