#pragma once
#include <optional>

#include "lib/levels/lod_chain.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

/// What the solid of a scene shows to the outside, and how far levels are from it. With the inside filled, every
/// boundary voxel is touched by the scene. While levels are meshed, it is but the runs of its voxels; what distances
/// are measured with is made when they are, unless it is small.
class Outside {
 public:
  const std::uint64_t dense_faces;  ///< triangles of the dense surface of the solid
  const VoxelBox box;               ///< around the boundary voxels

  /// `surface`: as LodOptions has it. `of_triangles`: fits are measured against triangles. Throws out_of_resource,
  /// before it takes anything, if it takes more than `memory`.
  Outside(const BrickShelf& solid, const BrickShelf* surface, bool of_triangles, const GridFrame& frame,
          const MemoryShare& memory);
  ~Outside();

  [[nodiscard]] double voxel() const { return frame_.voxel; }
  /// Around all of the solid's voxels, scene units.
  [[nodiscard]] Bounds3d bounds() const;
  /// Of the memory, from the beginning to the end.
  [[nodiscard]] std::uint64_t bytes() const;

  /// Sets error_world and distance_world of a level. `scene`: its triangles, if a bounding level has them inside, or a
  /// fit follows them; else null. Takes TriangleBvh::bytes_needed() of them for a moment.
  void measure(LodLevel& level, MeshMode mode, const std::vector<TriangleD>* scene) const;

 private:
  struct Ruler;

  Outside(const BrickShelf& solid, const BrickShelf* surface, bool of_triangles, const GridFrame& frame,
          const BoundarySize& size, const MemoryShare& memory);
  void measure_bounding(LodLevel& level, const std::vector<TriangleD>* enclosed) const;
  /// False, and nothing, if the triangles are not those of the voxels.
  [[nodiscard]] bool measure_fit(LodLevel& level, const std::vector<TriangleD>& scene) const;
  template <class Use>
  void with_ruler(Use&& use) const;

  GridFrame frame_;
  std::vector<VoxelRun> runs_;
  std::vector<FaceRect> faces_;  // between its voxels and empty ones, if fits are measured against triangles
  std::unique_ptr<Ruler> kept_;
};

}  // namespace bp
