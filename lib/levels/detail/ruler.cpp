// Why levels around triangles are measured against all triangles, and not only against the ones that are shown to the
// outside: both distances are the same. The space between a point of the level and the nearest triangle is empty, and
// everything outside the level's surface is reached by the outside. So nothing need be known of what is shown, and the
// voxels add no error.
#include "lib/levels/detail/ruler.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/geometry/surface_distance.h"
#include "lib/levels/detail/shown_scene.h"
#include "lib/levels/detail/voxel_distance.h"
#include "lib/pass/mesh/surface_around.h"

namespace bp {

namespace {

/// Returns the bytes that the segments of runs and a tree over them take while they are used.
std::uint64_t segment_bytes(std::uint64_t runs) {
  return TriangleBvh::bytes_with_triangles(runs);
}

/// Returns the bytes that measuring against the shown triangles takes, with the faces that are kept for it.
std::uint64_t shown_bytes(std::uint64_t faces) {
  return faces * sizeof(FaceRect) +
         std::min(faces, kMostShownPoints) * (2 * sizeof(TriangleD) + TriangleBvh::bytes_needed(1));
}

/// The counts of the voxels' surface that decide a ruler's memory.
struct SurfaceSize {
  std::uint64_t runs = 0;
  std::uint64_t shown_faces = 0;  ///< faces of voxels that tell which triangles are shown

  SurfaceSize(const RulerScene& scene, const BoundarySize& size, bool has_triangles)
      : runs(scene.surface != nullptr ? count_runs(*scene.surface, size.box) : size.runs),
        shown_faces(has_triangles && scene.surface == nullptr ? size.faces : 0) {}
  /// Returns the bytes while distances are measured.
  [[nodiscard]] std::uint64_t bytes() const {
    return runs * sizeof(VoxelRun) + segment_bytes(runs) + shown_bytes(shown_faces);
  }
  [[nodiscard]] std::uint64_t kept_bytes() const { return runs * sizeof(VoxelRun) + shown_faces * sizeof(FaceRect); }
};

bool is_small(std::uint64_t bytes, const MemoryShare& memory) {
  return bytes <= memory.bytes / kSmallShare;
}

}  // namespace

Ruler::Ruler(const RulerScene& scene, const MemoryShare& memory) : Ruler(scene, boundary_size(scene.solid), memory) {}

Ruler::Ruler(const RulerScene& scene, const BoundarySize& size, const MemoryShare& memory)
    : dense_faces(2 * size.faces), box(size.box), frame_(scene.frame), mode_(scene.mode), triangles_(scene.triangles) {
  if (mode_ == MeshMode::fit || triangles_ == nullptr) take_surface(scene, size, memory);
  if (triangles_ != nullptr)
    scene_ = Surface(triangles_, is_small(TriangleBvh::bytes_needed(triangles_->size()), memory));
}

RulerBytes Ruler::bytes_needed(const RulerScene& scene, bool has_triangles) {
  if (scene.mode != MeshMode::fit && has_triangles) return {};
  const SurfaceSize surface(scene, boundary_size(scene.solid), has_triangles);
  return {surface.bytes(), surface.kept_bytes()};
}

void Ruler::take_surface(const RulerScene& scene, const BoundarySize& size, const MemoryShare& memory) {
  const SurfaceSize surface(scene, size, triangles_ != nullptr);
  const std::uint64_t bytes = surface.bytes();
  if (bytes > memory.bytes)
    throw NeedsMemory("measuring distances to the outside of the scene", bytes, memory.bytes,
                      memory.limit_with(bytes - memory.bytes), {Remedy::larger_voxels});
  runs_ = scene.surface != nullptr ? runs_of(*scene.surface, box) : boundary_of(scene.solid).runs;
  runs_.shrink_to_fit();
  if (surface.shown_faces > 0) faces_ = boundary_rects(scene.solid);
  if (!is_small(segment_bytes(surface.runs), memory)) return;
  segments_ = segments_of(runs_, frame_);
  kept_segments_ = Surface(&segments_, true);
}

std::uint64_t Ruler::bytes() const {
  return runs_.capacity() * sizeof(VoxelRun) + faces_.capacity() * sizeof(FaceRect) +
         segments_.capacity() * sizeof(TriangleD) + kept_segments_.bytes() + scene_.bytes();
}

std::uint64_t Ruler::bytes_of_measure() const {
  const std::uint64_t segments = segments_.empty() ? segment_bytes(runs_.size()) : 0;
  const bool has_tree = triangles_ == nullptr || scene_.bytes() > 0;
  return segments + (has_tree ? 0 : TriangleBvh::bytes_needed(triangles_->size()));
}

template <class Use>
decltype(auto) Ruler::with_segments(Use&& use) const {
  return segments_.empty() ? use(segments_of(runs_, frame_)) : use(segments_);
}

template <class Use>
decltype(auto) Ruler::with_segment_tree(Use&& use) const {
  return with_segments([&](const std::vector<TriangleD>& segments) {
    const Surface made(&segments, false);
    const Surface& surface = segments_.empty() ? made : kept_segments_;
    return surface.with_tree([&](const TriangleBvh& tree) { return use(segments, tree); });
  });
}

std::optional<double> Ruler::error(const LatticeMesh& mesh, double limit) const {
  const std::vector<TriangleD> triangles = world_triangles(mesh);
  if (mode_ == MeshMode::fit) {
    std::optional<double> error;
    if (triangles_ != nullptr) error = error_of_fit(triangles);
    return error ? *error : error_of_fit_to_voxels(triangles);
  }
  if (triangles_ == nullptr) return error_around_voxels(triangles);
  SearchEffort effort;
  effort.enough = limit;
  const SurfaceDistance found = scene_.with_tree(
      [&](const TriangleBvh& tree) { return largest_distance(triangles, tree, kTriangleTolerance * voxel(), effort); });
  if (found.at_least > limit) return std::nullopt;
  return found.at_most;
}

double Ruler::error_around_voxels(const std::vector<TriangleD>& mesh) const {
  return with_segment_tree(
      [&](const std::vector<TriangleD>&, const TriangleBvh& tree) { return distance_from_mesh(mesh, tree, voxel()); });
}

double Ruler::error_of_fit_to_voxels(const std::vector<TriangleD>& mesh) const {
  return with_segment_tree([&](const std::vector<TriangleD>& segments, const TriangleBvh& tree) {
    const double there = distance_from_mesh(mesh, tree, voxel());
    return distance_beyond_mesh(segments, TriangleBvh(mesh), voxel(), there);
  });
}

std::optional<double> Ruler::error_of_fit(const std::vector<TriangleD>& mesh) const {
  return scene_.with_tree([&](const TriangleBvh& scene) -> std::optional<double> {
    const std::vector<TriangleD> shown = shown_points(faces_, scene, frame_);
    if (shown.empty()) return std::nullopt;
    const double there = largest_distance(mesh, TriangleBvh(shown), kTriangleTolerance * voxel()).at_most;
    return with_segments([&](const std::vector<TriangleD>& segments) {
      return distance_beyond_mesh(runs_, segments, scene, frame_, TriangleBvh(mesh), there);
    });
  });
}

}  // namespace bp
