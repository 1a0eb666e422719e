// Where the triangles of the scene are known, and lie inside a level, the distance to all of them is the distance to
// those that are shown: what lies between a point of the level and the nearest triangle is empty, and the level lets
// the outside up to its surface. So nothing need be known of what is shown, and the voxels add no error of theirs.
#include "lib/levels/detail/outside.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/geometry/surface_distance.h"
#include "lib/levels/detail/shown_scene.h"
#include "lib/levels/detail/voxel_distance.h"
#include "lib/pass/mesh/surface_around.h"

namespace bp {

namespace {

/// That measuring takes for a moment.
std::uint64_t measuring_bytes(std::uint64_t runs) {
  return runs * sizeof(TriangleD) + TriangleBvh::bytes_needed(runs);
}

/// The same of distances to triangles, and the faces that are kept for it.
std::uint64_t shown_bytes(std::uint64_t faces) {
  return faces * sizeof(FaceRect) +
         std::min(faces, kMostShownPoints) * (2 * sizeof(TriangleD) + TriangleBvh::bytes_needed(1));
}

}  // namespace

struct Outside::Ruler {
  std::vector<TriangleD> segments;
  TriangleBvh tree;

  Ruler(const std::vector<VoxelRun>& runs, const GridFrame& frame)
      : segments(segments_of(runs, frame)), tree(segments) {}
};

Outside::Outside(const BrickShelf& solid, const BrickShelf* surface, bool of_triangles, const GridFrame& frame,
                 const MemoryShare& memory)
    : Outside(solid, surface, of_triangles && surface == nullptr, frame, boundary_size(solid), memory) {}

Outside::Outside(const BrickShelf& solid, const BrickShelf* surface, bool of_triangles, const GridFrame& frame,
                 const BoundarySize& size, const MemoryShare& memory)
    : dense_faces(2 * size.faces), box(size.box), frame_(frame) {
  const std::uint64_t runs = surface != nullptr ? count_runs(*surface, box) : size.runs;
  const std::uint64_t bytes =
      runs * sizeof(VoxelRun) + measuring_bytes(runs) + (of_triangles ? shown_bytes(size.faces) : 0);
  if (bytes > memory.bytes)
    throw NeedsMemory("measuring distances to the outside of the scene", bytes, memory.bytes,
                      memory.limit_with(bytes - memory.bytes), {Remedy::larger_voxels});
  runs_ = surface != nullptr ? runs_of(*surface, box) : boundary_of(solid).runs;
  runs_.shrink_to_fit();
  if (of_triangles) faces_ = boundary_rects(solid);
  if (measuring_bytes(runs) <= memory.bytes / 16) kept_ = std::make_unique<Ruler>(runs_, frame_);
}

Outside::~Outside() = default;

Bounds3d Outside::bounds() const {
  Bounds3d bounds;
  for (const VoxelCoord& v : {box.min, box.max})
    bounds.add(frame_.world(LatticeCoord{v.x, v.y, v.z} * kLatticePerVoxel));
  return bounds;
}

std::uint64_t Outside::bytes() const {
  return runs_.capacity() * sizeof(VoxelRun) + faces_.capacity() * sizeof(FaceRect) +
         (kept_ ? measuring_bytes(runs_.size()) : 0);
}

template <class Use>
void Outside::with_ruler(Use&& use) const {
  kept_ ? use(*kept_) : use(Ruler(runs_, frame_));
}

void Outside::measure(LodLevel& level, MeshMode mode, const std::vector<TriangleD>* scene) const {
  if (mode == MeshMode::bounding) return measure_bounding(level, scene);
  if (scene != nullptr && measure_fit(level, *scene)) return;
  const std::vector<TriangleD> triangles = world_triangles(level.mesh);
  with_ruler([&](const Ruler& ruler) {
    const TriangleBvh mesh(triangles);
    const double there = distance_from_mesh(triangles, ruler.tree, voxel());
    level.error_world = distance_beyond_mesh(ruler.segments, mesh, voxel(), there);
    level.distance_world = std::max(there, distance_to_mesh(ruler.segments, mesh, voxel()));
  });
}

void Outside::measure_bounding(LodLevel& level, const std::vector<TriangleD>* enclosed) const {
  const std::vector<TriangleD> triangles = world_triangles(level.mesh);
  std::optional<double> known;  // before a ruler is made: the tree of the enclosed triangles is gone by then
  if (enclosed != nullptr)
    known = largest_distance(triangles, TriangleBvh(*enclosed), kTriangleTolerance * voxel()).at_most;
  with_ruler([&](const Ruler& ruler) {
    level.error_world = known ? *known : distance_from_mesh(triangles, ruler.tree, voxel());
    level.distance_world =
        std::max(level.error_world, distance_to_mesh(ruler.segments, TriangleBvh(triangles), voxel()));
  });
}

bool Outside::measure_fit(LodLevel& level, const std::vector<TriangleD>& scene) const {
  const TriangleBvh tree(scene);
  const std::vector<TriangleD> triangles = world_triangles(level.mesh);
  double there = 0;
  {
    const std::vector<TriangleD> shown = shown_points(faces_, tree, frame_);
    if (shown.empty()) return false;
    there = distance_from_mesh_to_shown(triangles, shown, voxel());
  }
  with_ruler([&](const Ruler& ruler) {
    const TriangleBvh mesh(triangles);
    level.error_world = distance_beyond_mesh(runs_, ruler.segments, tree, frame_, mesh, there);
    level.distance_world = std::max(there, distance_to_mesh(ruler.segments, mesh, voxel()));
  });
  return true;
}

}  // namespace bp
